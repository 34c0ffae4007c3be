#include <sstream>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/catalog_entry.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

using internal::CatalogEntry;
using internal::CatalogJoint;
using internal::CatalogPose;

std::vector<std::vector<std::string>> lists_of_names(const std::string& lines) {
  std::vector<std::vector<std::string>> lists;
  std::istringstream text(lines);
  for (std::string line; std::getline(text, line);) {
    std::istringstream names(line);
    lists.emplace_back();
    for (std::string name; names >> name;) lists.back().push_back(name);
  }
  return lists;
}

Pose pose_of(const CatalogPose& pose) {
  const auto& [roll, pitch, yaw] = pose.rpy;
  return make_pose(Vector3(pose.xyz), rotation(RollPitchYaw{roll, pitch, yaw}));
}

Joint joint_of(const CatalogJoint& entry, const std::optional<DhConvention>& convention) {
  Joint joint;
  if (convention) {
    joint = dh_joint(entry.row, *convention);
  } else {
    const Vector3 axis(entry.axis);
    joint.offset = pose_of(entry.offset);
    joint.screw = entry.kind == JointKind::prismatic ? translation_screw(axis)
                                                     : rotation_screw(axis, Vector3(entry.point));
  }
  joint.name = entry.name;
  joint.limits = entry.limits;
  return joint;
}

Arm arm_of(const CatalogEntry& entry) {
  std::vector<Joint> joints;
  for (const CatalogJoint& joint : entry.joints)
    joints.push_back(joint_of(joint, entry.convention));
  const Pose tool = pose_of(entry.tool), base = pose_of(entry.base);
  if (!entry.controller_base) return Arm(entry.name, std::move(joints), tool, base);
  return Arm(
      entry.name, std::move(joints), tool, base,
      ControllerFrames{.base = pose_of(*entry.controller_base), .flange = pose_of(*entry.flange)});
}

}  // namespace

const std::vector<BuiltInArm>& built_in_arms() {
  static const std::vector<BuiltInArm> arms = [] {
    std::vector<BuiltInArm> all;
    for (const CatalogEntry& entry : internal::catalog_entries()) {
      all.push_back({entry.name, entry.maker, entry.model, entry.source, entry.note,
                     entry.shapes_source, lists_of_names(entry.joint_names)});
    }
    return all;
  }();
  return arms;
}

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const BuiltInArm& arm : built_in_arms()) names.push_back(arm.name);
  return names;
}

Arm built_in(std::string_view name) {
  for (const CatalogEntry& entry : internal::catalog_entries()) {
    if (entry.name == name) return arm_of(entry);
  }
  throw unknown_name("built-in arm", name, built_in_names());
}

}  // namespace beeline
