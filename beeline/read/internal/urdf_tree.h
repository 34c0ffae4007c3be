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

/// Returns the ends of the chain down the tree that has these joints: indices into `file.joints`,
/// in any order. Fixed joints on other branches are ignored.
/// Throws Error, a clause without a subject, when there is none: joints with one degree of freedom
/// on two branches, or, mimic joints aside, one between the ends that is not among them.
ChainEnds ends_of_joints(const UrdfFile& file, const std::vector<std::size_t>& joints);

}  // namespace beeline::internal
