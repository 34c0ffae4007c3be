#include <algorithm>
#include <string_view>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/catalog_entry.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

using internal::CatalogEntry;
using internal::CatalogJoint;
using internal::CatalogPose;

/// Returns the parts of a text, behind each of which stands a separator.
std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; (end = text.find(separator)) != text.npos;
       text.remove_prefix(end + 1)) {
    parts.emplace_back(text.substr(0, end));
  }
  return parts;
}

std::vector<std::vector<std::string>> lists_of_names(std::string_view lines) {
  std::vector<std::vector<std::string>> lists;
  for (const std::string& line : parts_of(lines, '\n')) lists.push_back(parts_of(line, '\t'));
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
  if (!entry.controller) return Arm(entry.name, std::move(joints), tool, base);
  return Arm(entry.name, std::move(joints), tool, base,
             ControllerFrames{.base = pose_of(entry.controller->base),
                              .flange = pose_of(entry.controller->flange)});
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

std::vector<std::vector<std::string>> joint_namings(const Arm& arm) {
  std::vector<std::vector<std::string>> namings{arm.joint_names()};
  for (const BuiltInArm& about : built_in_arms()) {
    if (about.name != arm.name()) continue;
    const std::vector<std::string> own = namings.front();
    const std::vector<std::string> last = built_in(about.name).joint_names();
    if (own.size() < last.size() || !std::equal(last.rbegin(), last.rend(), own.rbegin())) continue;
    for (const std::vector<std::string>& of_arm : about.joint_names) {
      std::vector<std::string> naming(own.begin(),
                                      own.end() - static_cast<std::ptrdiff_t>(last.size()));
      naming.insert(naming.end(), of_arm.begin(),
                    of_arm.end());  // behind a rail's or base's joints
      namings.push_back(std::move(naming));
    }
  }
  return namings;
}

std::optional<int> coordinate_called(const Arm& arm, std::string_view joint) {
  for (const std::vector<std::string>& naming : joint_namings(arm)) {
    const auto found = std::find(naming.begin(), naming.end(), joint);
    if (found != naming.end()) return static_cast<int>(found - naming.begin());
  }
  return std::nullopt;
}

}  // namespace beeline
