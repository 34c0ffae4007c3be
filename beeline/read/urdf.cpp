#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/model/internal/ranges.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_file.h>
#include <beeline/read/internal/urdf_frames.h>
#include <beeline/read/internal/urdf_tree.h>
#include <beeline/read/urdf.h>

namespace beeline {
namespace {

using internal::ChainJoint;
using internal::UrdfFile;

/// Returns the joint from its parent link to its child link, without the offset of its origin.
Joint moving_joint(const UrdfFile& file, const UrdfFile::Joint& urdf) {
  Joint joint;
  joint.name = urdf.name;
  joint.link = urdf.child;
  joint.limits = urdf.limits;
  joint.mimic = urdf.mimic;
  try {
    joint.screw =
        urdf.type == "prismatic" ? translation_screw(urdf.axis) : rotation_screw(urdf.axis);
  } catch (const Error& error) {
    throw FileError(file.path, urdf.axis_line, "joint " + urdf.name + ": " + error.what());
  }
  if (urdf.limits.lower > urdf.limits.upper) {
    throw FileError(file.path, urdf.limit_line,
                    "joint " + urdf.name + ": lower limit " + number(urdf.limits.lower) +
                        " exceeds upper limit " + number(urdf.limits.upper));
  }
  if (urdf.limits.velocity < Limits::min_rate) {
    throw FileError(file.path, urdf.limit_line,
                    "joint " + urdf.name + ": velocity limit " + number(urdf.limits.velocity) +
                        " is below " + number(Limits::min_rate) + "; 0 stands for none");
  }
  return joint;
}

/// Returns the arm's joint, whose frame is the child link's or, if it is reversed, the parent
/// link's; `before` is the pose of its first link in the frame of the joint before it.
Joint chain_joint(const UrdfFile& file, const ChainJoint& place, const Pose& before) {
  const UrdfFile::Joint& urdf = file.joints[place.index];
  Joint joint = moving_joint(file, urdf);
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

[[noreturn]] void refuse_type(const UrdfFile& file, const UrdfFile::Joint& joint) {
  throw FileError(file.path, joint.line,
                  "joint " + joint.name + " is " + internal::in_quotes(joint.type) +
                      "; a chain has revolute, continuous, prismatic and fixed joints");
}

/// Refuses mimic joints of the chain whose leader is not in the file.
void check_leaders(const UrdfFile& file, const std::vector<ChainJoint>& chain) {
  std::vector<std::string> names;
  for (const UrdfFile::Joint& joint : file.joints) names.push_back(joint.name);
  const std::unordered_set<std::string> known(names.begin(), names.end());
  for (const ChainJoint& place : chain) {
    const UrdfFile::Joint& joint = file.joints[place.index];
    if (!joint.mimic || known.contains(joint.mimic->leader)) continue;
    const Error unknown = unknown_name("joint", internal::printable(joint.mimic->leader), names);
    throw FileError(file.path, joint.mimic_line,
                    "joint " + joint.name + " mimics an " + unknown.what());
  }
}

/// Gives each mimic joint whose leader is not on the chain its own coordinate.
void free_followers(std::vector<Joint>& joints) {
  std::unordered_set<std::string> names;
  for (const Joint& joint : joints) names.insert(joint.name);
  for (Joint& joint : joints) {
    if (joint.mimic && !names.contains(joint.mimic->leader)) joint.mimic.reset();
  }
}

}  // namespace

Arm arm_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends,
                  std::vector<std::string>* notes) {
  const UrdfFile file = internal::parse_urdf(text, path);
  const std::vector<ChainJoint> chain = internal::cut_chain(file, ends, notes);
  check_leaders(file, chain);
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();  // from the last moving joint's frame
  for (const ChainJoint& place : chain) {
    const UrdfFile::Joint& urdf = file.joints[place.index];
    if (urdf.type == "fixed") {
      fixed = fixed * (place.reversed ? urdf.origin.inverse() : urdf.origin);
      continue;
    }
    if (!has_one_dof(urdf)) refuse_type(file, urdf);
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
  free_followers(joints);
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

Arm read_urdf(const std::string& path, const ChainEnds& ends, std::vector<std::string>* notes) {
  return arm_from_urdf(internal::read_file(path), path, ends, notes);
}

}  // namespace beeline
