#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/urdf_tree.h>

namespace beeline::internal {

/// Returns the joints from the base to the tip, in this order, without those of a gripper behind
/// them and without floating and planar joints before them, as read_urdf() documents. Appends to
/// `warnings`, unless null, what was selected and the faults beside the chain.
/// Throws FileError for a fault on the chain; without `ends.tip` also for one that the chain may be
/// meant to have; and when several chains match `ends`.
std::vector<ChainJoint> cut_chain(const UrdfFile& file, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings = nullptr);
/// The same of the file's tree.
std::vector<ChainJoint> cut_chain(const UrdfTree& tree, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings = nullptr);

}  // namespace beeline::internal
