#pragma once

#include <Eigen/Core>
#include <functional>

namespace beeline::internal {

/// Calls `work(first, last)` for consecutive blocks of `block` indices from 0 to count, on
/// `threads` threads (0: one for each core). The blocks do not depend on the number of threads.
void in_parallel(Eigen::Index count, Eigen::Index block, int threads,
                 const std::function<void(Eigen::Index, Eigen::Index)>& work);

}  // namespace beeline::internal
