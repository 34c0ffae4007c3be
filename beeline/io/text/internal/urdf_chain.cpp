#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/urdf_chain.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_gripper.h>
#include <beeline/io/text/pose_list.h>

namespace beeline::internal {
namespace {

using Chain = std::vector<ChainJoint>;

/// Removes the joints of a gripper, and all joints behind them, from the end of the chain. A chain
/// of nothing else is a finger that its user wants.
void end_before_gripper(const UrdfFile& file, Chain& chain, std::vector<ReadWarning>& warnings) {
  std::size_t length = chain.size();
  bool moves = false;  // a joint before the gripper
  for (std::size_t i = chain.size(); i-- > 0 && !moves;) {
    const UrdfFile::Joint& joint = file.joints[chain[i].index];
    if (!has_one_dof(joint)) continue;
    moves = chain[i].reversed || !moves_finger(joint);
    if (!moves) length = i;
  }
  if (!moves || length == chain.size()) return;
  const UrdfFile::Joint& first = file.joints[chain[length].index];
  warnings = {{.kind = ReadWarningKind::before_gripper,
               .path = file.path,
               .joint = first.name,
               .link = first.parent,
               .others = {file.joints[chain.back().index].child}}};
  chain.resize(length);
}

/// Removes the joints up to the last floating or planar one before the first joint of the arm: they
/// place the robot in the world.
void begin_below_free_joint(const UrdfFile& file, Chain& chain,
                            std::vector<ReadWarning>& warnings) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const UrdfFile::Joint& joint = file.joints[chain[i].index];
    if (chain[i].reversed) return;
    if (is_free(joint)) begin = i + 1;
    if (!has_one_dof(joint)) continue;
    if (begin == 0) return;
    const UrdfFile::Joint& free = file.joints[chain[begin - 1].index];
    warnings.push_back({.kind = ReadWarningKind::below_free_joint,
                        .path = file.path,
                        .joint = free.name,
                        .link = free.child});
    chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(begin));
    return;
  }
}

void check_faults(const UrdfFile& file, const UrdfTree& tree, const Chain& chain,
                  bool tip_is_given) {
  if (const UrdfFault* fault = tree.first_fault_on(chain)) throw error_of(file, *fault);
  if (tip_is_given) return;
  for (const UrdfFault& fault : tree.faults()) {
    if (fault.moves)
      throw error_of(file, fault, "; the option tip (--tip) selects a chain beside it");
  }
}

void warn_of_faults(const UrdfFile& file, const UrdfTree& tree,
                    std::vector<ReadWarning>& warnings) {
  constexpr std::size_t most = 10;
  const std::vector<UrdfFault>& faults = tree.faults();
  std::vector<ReadWarning> listed = warnings_of(file, faults, most);
  const std::size_t further = faults.size() - listed.size() + file.further_faults;
  warnings.insert(warnings.end(), listed.begin(), listed.end());
  if (further == 0) return;
  warnings.push_back(
      {.kind = ReadWarningKind::further_faults, .path = file.path, .count = further});
}

/// Adds a warning of the first angle of the chain that is more than a revolution.
void warn_of_degrees(const UrdfFile& file, const Chain& chain, std::vector<ReadWarning>& warnings) {
  for (const ChainJoint& place : chain) {
    const UrdfFile::Joint& joint = file.joints[place.index];
    Eigen::Index largest = 0;
    if (joint.rpy.cwiseAbs().maxCoeff(&largest) <= plausible_angle) continue;
    warnings.push_back({.kind = ReadWarningKind::likely_degrees,
                        .path = file.path,
                        .line = joint.line,
                        .joint = joint.name,
                        .numbers = {joint.rpy[largest]}});
    return;
  }
}

}  // namespace

std::vector<ChainJoint> cut_chain(const UrdfFile& file, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings) {
  return cut_chain(UrdfTree(file), ends, warnings);
}

std::vector<ChainJoint> cut_chain(const UrdfTree& tree, const ChainEnds& ends,
                                  std::vector<ReadWarning>* warnings) {
  const UrdfFile& file = tree.file();
  const std::size_t base = tree.base(ends.base);
  const UrdfTree::Tip tip = tree.tip(ends.tip, base);
  Chain chain = tree.chain(base, tip.link);
  std::vector<ReadWarning> found;
  if (tip.choice) {
    found.push_back({.kind = *tip.choice,
                     .path = file.path,
                     .link = file.links[tip.link].name,
                     .others = tip.others});
  }
  if (ends.tip.empty()) end_before_gripper(file, chain, found);
  if (ends.base.empty()) begin_below_free_joint(file, chain, found);
  const bool moves = std::any_of(chain.begin(), chain.end(), [&](const ChainJoint& place) {
    return has_one_dof(file.joints[place.index]);
  });
  if (!moves && ends.tip.empty()) {
    if (const UrdfFault* fault = tree.first_fault()) throw error_of(file, *fault);
  }
  check_faults(file, tree, chain, !ends.tip.empty());
  warn_of_degrees(file, chain, found);
  if (warnings == nullptr) return chain;
  warnings->insert(warnings->end(), found.begin(), found.end());
  warn_of_faults(file, tree, *warnings);
  return chain;
}

}  // namespace beeline::internal
