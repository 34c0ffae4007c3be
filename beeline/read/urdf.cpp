#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_file.h>
#include <beeline/read/internal/urdf_tree.h>
#include <beeline/read/urdf.h>

namespace beeline {
namespace {

using internal::UrdfFile;

/// Returns the arm's joint; `origin` is the pose of its frame in the frame of the joint before it.
Joint moving_joint(const UrdfFile& file, const UrdfFile::Joint& urdf, const Pose& origin) {
  Joint joint;
  joint.name = urdf.name;
  joint.link = urdf.child;
  joint.offset = origin;
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

[[noreturn]] void refuse_type(const UrdfFile& file, const UrdfFile::Joint& joint) {
  throw FileError(file.path, joint.line,
                  "joint " + joint.name + " is " + internal::in_quotes(joint.type) +
                      "; a chain has revolute, continuous, prismatic and fixed joints");
}

/// Refuses mimic joints of the chain whose leader is not in the file.
void check_leaders(const UrdfFile& file, const std::vector<std::size_t>& chain) {
  std::vector<std::string> names;
  for (const UrdfFile::Joint& joint : file.joints) names.push_back(joint.name);
  const std::unordered_set<std::string> known(names.begin(), names.end());
  for (const std::size_t index : chain) {
    const UrdfFile::Joint& joint = file.joints[index];
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

Arm arm_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends) {
  const UrdfFile file = internal::parse_urdf(text, path);
  const std::vector<std::size_t> chain = internal::cut_chain(file, ends);
  check_leaders(file, chain);
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();  // from the last moving joint's frame
  for (const std::size_t index : chain) {
    const UrdfFile::Joint& urdf = file.joints[index];
    fixed = fixed * urdf.origin;
    if (urdf.type == "fixed") continue;
    if (!has_one_dof(urdf)) refuse_type(file, urdf);
    joints.push_back(moving_joint(file, urdf, fixed));
    fixed = Pose::Identity();
  }
  if (joints.empty() || joints.size() > max_joints) {
    throw FileError(path, 0,
                    "has " + std::string(joints.empty() ? "no" : "more than 10000") +
                        " moving joints between its base and its tip");
  }
  free_followers(joints);
  try {
    return {file.name, std::move(joints), fixed};
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

Arm read_urdf(const std::string& path, const ChainEnds& ends) {
  return arm_from_urdf(internal::read_file(path), path, ends);
}

}  // namespace beeline
