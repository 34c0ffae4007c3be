#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

Pose screw_transform(const Vector3& axis, double angle, double distance) {
  return make_pose(distance * axis, Eigen::AngleAxisd(angle, axis).toRotationMatrix());
}

}  // namespace

Joint dh_joint(const DhRow& row, DhConvention convention) {
  if (row.kind == JointKind::helical) {
    throw Error("a DH row is revolute or prismatic; a helical joint needs the \"screw\" form");
  }
  Joint joint;
  joint.screw = row.kind == JointKind::revolute ? rotation_screw(Vector3::UnitZ())
                                                : translation_screw(Vector3::UnitZ());
  const Pose along_z = screw_transform(Vector3::UnitZ(), row.theta, row.d);
  const Pose along_x = screw_transform(Vector3::UnitX(), row.alpha, row.a);
  if (convention == DhConvention::modified) {
    joint.offset = along_x * along_z;  // the joint's motion commutes with along_z
    return joint;
  }
  joint.offset = along_z;
  return with_link_frame(joint, along_x);
}

Arm arm_from_dh(const std::string& name, std::span<const DhRow> rows, DhConvention convention,
                std::span<const Limits> limits) {
  if (!limits.empty() && limits.size() != rows.size()) {
    throw Error(
        "", "limits",
        ": " + std::to_string(limits.size()) + " for " + std::to_string(rows.size()) + " joints");
  }
  std::vector<Joint> joints;
  for (const DhRow& row : rows) {
    joints.push_back(dh_joint(row, convention));
    if (!limits.empty()) joints.back().limits = limits[joints.size() - 1];
    joints.back().name = "joint" + std::to_string(joints.size());
  }
  return Arm(name, joints);
}

}  // namespace beeline
