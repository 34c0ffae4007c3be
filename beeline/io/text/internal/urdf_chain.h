#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/urdf_tree.h>

namespace beeline::internal {

/// Returns the joints from the base to the tip, in this order, without the joints of a gripper
/// behind them and without floating and planar joints before them, as read_urdf() documents.
/// Appends to `warnings`, unless null, what was selected and the faults beside the chain.
/// Throws FileError for a fault on the chain, for several chains that match `ends`, and, without
/// `ends.tip`, for a fault on joints that may be meant to be on the chain.
std::vector<ChainJoint> cut_chain(const UrdfFile& file, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings = nullptr);
/// The same of the file's tree.
std::vector<ChainJoint> cut_chain(const UrdfTree& tree, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings = nullptr);

}  // namespace beeline::internal
