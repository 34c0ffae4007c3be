#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <beeline/read/arm.h>
#include <beeline/read/internal/urdf_file.h>

namespace beeline::internal {

/// A joint on the way from a base to a tip.
struct ChainJoint {
  std::size_t index = 0;  ///< in `UrdfFile::joints`
  bool reversed = false;  ///< passed from the child link to the parent link

  bool operator==(const ChainJoint&) const = default;
};

/// Returns the joints from the base to the tip, in this order. Selects the tip as read_urdf()
/// documents and appends to `notes`, unless null, the choice among several.
/// Throws FileError when links and joints do not form a tree, or when several chains match `ends`.
std::vector<ChainJoint> cut_chain(const UrdfFile& file, const ChainEnds& ends,
                                  std::vector<std::string>* notes = nullptr);

}  // namespace beeline::internal
