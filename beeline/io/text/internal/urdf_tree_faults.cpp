#include <algorithm>
#include <string_view>
#include <unordered_set>

#include <beeline/io/text/internal/urdf_ignored.h>
#include <beeline/io/text/internal/urdf_tree.h>

// The faults of the links and joints of a chain, found in one pass over each.

namespace beeline::internal {
namespace {

/// The links and joints of a chain.
struct ChainMembers {
  std::vector<bool> joints;                                 ///< by index in the file
  std::unordered_set<std::string_view> joint_names, links;  ///< leaders of mimic joints included
  std::unordered_set<std::string_view> children;            ///< links below a joint

  ChainMembers(const UrdfFile& file, const std::vector<ChainJoint>& chain)
      : joints(file.joints.size(), false) {
    for (const ChainJoint& place : chain) {
      const UrdfFile::Joint& joint = file.joints[place.index];
      joints[place.index] = true;
      joint_names.insert(joint.name);
      if (joint.mimic) joint_names.insert(joint.mimic->leader);
      links.insert({joint.parent, joint.child});
      children.insert(joint.child);
    }
  }

  bool has(const UrdfFault& fault) const { return fault.index && joints[*fault.index]; }
  bool has_named(const ReadWarning& fault) const {
    return joint_names.contains(fault.joint) || links.contains(fault.link);
  }
};

}  // namespace

const UrdfFault* UrdfTree::first_fault() const {
  const auto first = std::find_if(faults_.begin(), faults_.end(), [](const UrdfFault& fault) {
    return fault.moves || !is_ignored(fault.warning.kind);
  });
  return first == faults_.end() ? nullptr : &*first;
}

const UrdfFault* UrdfTree::first_fault_on(const std::vector<ChainJoint>& chain) const {
  const ChainMembers members(file_, chain);
  std::vector<bool> cycles(file_.links.size(), false);  // by the link that closes it
  for (const std::string_view link : members.links) {
    const std::size_t cycle = cycle_of_[index_.at(std::string(link))];
    if (cycle != no_cycle) cycles[cycle] = true;
  }
  const auto concerns = [&](const UrdfFault& fault) {
    const ReadWarning& warning = fault.warning;
    switch (warning.kind) {
      case ReadWarningKind::malformed:
        return members.has(fault) ||
               (warning.element_fault == ElementFault::not_utf8 && members.has_named(warning));
      case ReadWarningKind::xacro_tag:
      case ReadWarningKind::zero_axis:
      case ReadWarningKind::limits_reversed:
      case ReadWarningKind::rate_limit:
      case ReadWarningKind::unknown_leader:
      case ReadWarningKind::leader_cycle:
      case ReadWarningKind::nonlinear_coupling:
        return members.has(fault);
      case ReadWarningKind::repeated_name:
        return members.has_named(warning);
      case ReadWarningKind::two_parents:
        return members.children.contains(warning.link);
      case ReadWarningKind::cycle:
        return static_cast<bool>(cycles[index_.at(warning.link)]);
      default:
        return false;
    }
  };
  for (const UrdfFault& fault : faults_) {
    if (concerns(fault)) return &fault;
  }
  return nullptr;
}

}  // namespace beeline::internal
