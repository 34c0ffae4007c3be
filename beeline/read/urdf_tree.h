#pragma once

#include <vector>

#include <beeline/read/arm.h>
#include <beeline/read/urdf_file.h>

namespace beeline {

/// The joints that lead from the base to the tip, as places in `file.joints`, in this order.
/// Throws FileError when links and joints form no tree, or the ends do not tell one chain.
std::vector<std::size_t> cut_chain(const UrdfFile& file, const ChainEnds& ends);

}  // namespace beeline
