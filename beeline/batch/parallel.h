#pragma once

#include <Eigen/Core>
#include <functional>

namespace beeline {

/// Calls `work(first, last)` for the blocks of 0 to count, by as many threads (0: as the machine
/// has). The blocks are the same for any number of threads.
void in_parallel(Eigen::Index count, Eigen::Index block, int threads,
                 const std::function<void(Eigen::Index, Eigen::Index)>& work);

}  // namespace beeline
