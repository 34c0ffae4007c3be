#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_gripper.h>
#include <beeline/io/text/internal/urdf_tree.h>

// The ends of the chain that has given joints: groups of SRDF files; and the palm of a gripper.

namespace beeline::internal {

/// Names the link that carries all fingers among these ends, with the option that ends the chain
/// there. Returns an empty text if there is none, or if no joint moves it relative to the base.
std::string UrdfTree::before_gripper(const std::vector<End>& ends, std::size_t base) const {
  std::unordered_map<std::size_t, std::size_t> known;
  Indices child_link;
  for (const UrdfFile::Joint& joint : file_.joints) {
    const auto child = index_.find(joint.child);
    child_link.push_back(child == index_.end() ? no_link : child->second);
  }
  const std::vector<bool> fingers =
      fingers_by_structure(file_, links_below(roots_), child_joints_, child_link);
  std::size_t palm = no_link;
  for (const End& end : ends) {
    const std::size_t own = palm_above(end.link, fingers, known);
    if (own == no_link) continue;
    if (palm != no_link && own != palm) return "";
    palm = own;
  }
  if (palm == no_link) return "";
  const std::vector<ChainJoint> joints = chain(base, palm);
  const bool moves = std::any_of(joints.begin(), joints.end(), [&](const ChainJoint& joint) {
    return has_one_dof(file_.joints[joint.index]);
  });
  return moves ? "; " + recommended("tip", name_of(palm)) + " ends before the gripper" : "";
}

/// Returns the link above the uppermost of the finger joints over a link, ignoring fixed joints;
/// no_link if the next joint does not move a finger. `fingers` has the finger joints recognised by
/// structure. `known` keeps the results for the links visited.
std::size_t UrdfTree::palm_above(std::size_t link, const std::vector<bool>& fingers,
                                 std::unordered_map<std::size_t, std::size_t>& known) const {
  Indices passed;
  std::size_t palm = no_link;
  for (;; link = parent_of(link)) {
    const auto found = known.find(link);
    if (found != known.end()) palm = found->second;
    if (found != known.end() || parent_joint_[link] == no_joint) break;
    const std::size_t j = parent_joint_[link];
    const UrdfFile::Joint& joint = file_.joints[j];
    if (joint.type != "fixed" && !fingers[j] && !moves_finger(joint)) break;
    passed.push_back(link);
  }
  for (auto below = passed.rbegin(); below != passed.rend(); ++below) {
    const bool finger = file_.joints[parent_joint_[*below]].type != "fixed";
    if (finger && palm == no_link) palm = parent_of(*below);
    known.emplace(*below, palm);
  }
  return palm;
}

ChainEnds UrdfTree::ends_of(const Indices& joints) const {
  std::vector<bool> wanted(file_.joints.size(), false);
  for (const std::size_t joint : joints) {
    wanted[joint] = true;
    if (!left_out_[joint]) continue;
    for (const UrdfFault& fault : faults_) {
      if (fault.index == joint) throw error_of(file_, fault);
    }
  }
  const std::vector<std::size_t> depths = joint_depths();
  std::size_t last = no_joint;  // the deepest joint that moves
  for (const std::size_t joint : joints) {
    if (!has_one_dof(file_.joints[joint])) continue;
    if (last == no_joint || depths[joint] > depths[last]) last = joint;
  }
  if (last == no_joint) throw Error("has no moving joint");
  std::size_t first = last;
  std::vector<bool> passed(file_.joints.size(), false);
  for (std::size_t joint = last; joint != no_joint;) {  // up to the root
    passed[joint] = true;
    if (wanted[joint]) first = joint;
    joint = parent_joint_[index_.at(file_.joints[joint].parent)];
  }
  for (const std::size_t joint : joints) {
    if (passed[joint] || !has_one_dof(file_.joints[joint])) continue;
    throw Error("is not a chain: joints " + file_.joints[joint].name + " and " +
                file_.joints[last].name + " are on two branches; select a base and a tip");
  }
  for (std::size_t joint = last; joint != first;) {
    const UrdfFile::Joint& between = file_.joints[joint];
    if (!wanted[joint] && has_one_dof(between) && !between.mimic) {
      throw Error("does not have joint " + between.name +
                  ", which moves between its base and its tip");
    }
    joint = parent_joint_[index_.at(between.parent)];
  }
  return {.base = file_.joints[first].parent, .tip = below_fixed(last, wanted, depths)};
}

/// The number of joints from the root to each joint.
std::vector<std::size_t> UrdfTree::joint_depths() const {
  std::vector<std::size_t> depths(file_.joints.size(), 0);
  for (const std::size_t link : links_below(roots_)) {  // from the roots on
    for (const std::size_t joint : child_joints_[link]) {
      if (parent_joint_[link] != no_joint) depths[joint] = depths[parent_joint_[link]] + 1;
    }
  }
  return depths;
}

/// Returns the deepest link below the joint that wanted fixed joints lead to.
std::string UrdfTree::below_fixed(std::size_t last, const std::vector<bool>& wanted,
                                  const std::vector<std::size_t>& depths) const {
  Indices fixed{last};
  std::size_t deepest = last;
  for (std::size_t next = 0; next < fixed.size(); ++next) {
    if (depths[fixed[next]] > depths[deepest]) deepest = fixed[next];
    for (const std::size_t joint : child_joints_[index_.at(file_.joints[fixed[next]].child)]) {
      if (wanted[joint] && file_.joints[joint].type == "fixed") fixed.push_back(joint);
    }
  }
  return file_.joints[deepest].child;
}

}  // namespace beeline::internal
