#pragma once

#include <vector>

#include <beeline/read/arm.h>
#include <beeline/read/internal/urdf_file.h>

namespace beeline::internal {

/// Returns the joints from the base to the tip, as indices into `file.joints`, in this order.
/// Throws FileError when links and joints do not form a tree, or when several chains match `ends`.
std::vector<std::size_t> cut_chain(const UrdfFile& file, const ChainEnds& ends);

}  // namespace beeline::internal
