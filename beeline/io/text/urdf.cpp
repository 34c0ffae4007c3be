#include <algorithm>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_chain.h>
#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/internal/urdf_frames.h>
#include <beeline/io/text/internal/urdf_mimic.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/internal/ranges.h>

namespace beeline {
namespace {

using internal::ChainJoint;
using internal::UrdfFile;

/// Returns the joint from its parent link to its child link, without the offset of its origin.
Joint moving_joint(const UrdfFile::Joint& urdf) {
  Joint joint;
  joint.name = urdf.name;
  joint.link = urdf.child;
  joint.limits = urdf.limits;
  joint.mimic = urdf.mimic;
  joint.screw = internal::screw_of(urdf);
  return joint;
}

/// Returns the arm's joint, whose frame is the child link's or, if it is reversed, the parent
/// link's; `before` is the pose of its first link in the frame of the joint before it.
Joint chain_joint(const UrdfFile& file, const ChainJoint& place, const Pose& before) {
  const UrdfFile::Joint& urdf = file.joints[place.index];
  Joint joint = moving_joint(urdf);
  if (!place.reversed) {
    joint.offset = before * urdf.origin;
    return joint;
  }
  // parent_T_child = origin exp(S q), so child_T_parent = exp(-S q) origin^-1.
  joint.offset = before;
  joint.screw = -joint.screw;
  joint.link = urdf.parent;
  return with_link_frame(std::move(joint), urdf.origin.inverse());
}

/// Refuses a joint with several degrees of freedom, or of an unknown type, on the chain.
[[noreturn]] void refuse_type(const UrdfFile& file, const std::vector<ChainJoint>& chain,
                              std::size_t i) {
  const UrdfFile::Joint& joint = file.joints[chain[i].index];
  const auto moves = [&](const ChainJoint& place) { return has_one_dof(file.joints[place.index]); };
  const auto at = chain.begin() + static_cast<std::ptrdiff_t>(i);
  std::string cure;
  if (std::any_of(at, chain.end(), moves)) {
    cure += internal::recommended("base", chain[i].reversed ? joint.parent : joint.child);
  }
  if (std::any_of(chain.begin(), at, moves)) {
    cure += std::string(cure.empty() ? "" : " or ") +
            internal::recommended("tip", chain[i].reversed ? joint.child : joint.parent);
  }
  const bool is_mjcf = file.is_mjcf;
  const std::string type = is_mjcf && is_free(joint) ? "free" : joint.type;
  throw FileError(path_of(file, joint), joint.line,
                  "joint " + joint.name + " is " + internal::in_quotes(type) + "; a chain has " +
                      (is_mjcf ? "hinge and slide joints"
                               : "revolute, continuous, prismatic and fixed joints") +
                      (cure.empty() ? "" : "; " + cure + " selects a chain without it"));
}

/// Returns the arm of a chain of the file.
Arm arm_of(const UrdfFile& file, const ChainEnds& ends, std::vector<ReadWarning>* warnings) {
  const std::string& path = file.path;
  const std::vector<ChainJoint> chain = internal::cut_chain(file, ends, warnings);
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();  // from the last moving joint's frame
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const ChainJoint& place = chain[i];
    const UrdfFile::Joint& urdf = file.joints[place.index];
    if (urdf.type == "fixed") {
      fixed = fixed * (place.reversed ? urdf.origin.inverse() : urdf.origin);
      continue;
    }
    if (!has_one_dof(urdf)) refuse_type(file, chain, i);
    joints.push_back(chain_joint(file, place, fixed));
    fixed = Pose::Identity();
  }
  if (joints.empty() || joints.size() > internal::max_joints) {
    throw FileError(
        path, 0,
        "has " +
            std::string(joints.empty() ? "no"
                                       : "more than " + std::to_string(internal::max_joints)) +
            " moving joints between its base and its tip");
  }
  internal::resolve_leaders(file, joints);
  const auto& [first, first_reversed] = chain.front();
  const auto& [last, last_reversed] = chain.back();
  const std::string& base = first_reversed ? file.joints[first].child : file.joints[first].parent;
  const std::string& tip = last_reversed ? file.joints[last].parent : file.joints[last].child;
  try {
    return {file.name, std::move(joints), fixed, Pose::Identity(),
            internal::controller_frames(file, base, tip, fixed)};
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

}  // namespace

Arm arm_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends,
                  std::vector<ReadWarning>* warnings) {
  const internal::ExpandedText expanded(text, path);
  const std::size_t before = warnings == nullptr ? 0 : warnings->size();
  const Arm arm = internal::with_lines_of(expanded, path, [&] {
    return arm_of(internal::parse_link_tree(expanded.text(), path), ends, warnings);
  });
  if (expanded.program().empty() || warnings == nullptr) return arm;
  for (std::size_t i = before; i < warnings->size(); ++i) {
    if ((*warnings)[i].path == path) (*warnings)[i].program = expanded.program();
  }
  return arm;
}

Arm read_urdf(const std::string& path, const ChainEnds& ends, std::vector<ReadWarning>* warnings) {
  return arm_from_urdf(read_file(path), path, ends, warnings);
}

}  // namespace beeline
