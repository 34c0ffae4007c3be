#include <cmath>
#include <optional>

#include <beeline/doctor/internal/explanations.h>
#include <beeline/doctor/internal/number_relation.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

bool same_screw(const Twist& a, const Twist& b, double tolerance) {
  return (a - b).norm() <= tolerance;
}

Vector3 axis_of(const Joint& joint) {
  return kind(joint) == JointKind::prismatic ? joint.screw.head<3>() : joint.screw.tail<3>();
}

std::string vector_text(const Vector3& v) { return number_list(v, " "); }

ModelDifference axis_difference(const Joint& a, const Joint& b, std::size_t joint) {
  const Vector3 axis_a = axis_of(a), axis_b = axis_of(b);
  std::string what = "axis " + vector_text(axis_a) + " in A, " + vector_text(axis_b) + " in B";
  for (const auto& [axis, arm] : {std::pair{axis_a, "A"}, std::pair{axis_b, "B"}}) {
    if (axis == Vector3::UnitX()) {
      what += std::string("; 1 0 0 is what URDF takes where <axis> is missing (in ") + arm + "?)";
      break;
    }
  }
  return {.kind = DifferenceKind::axis,
          .joint = static_cast<int>(joint),
          .parameter = "axis",
          .what = what};
}

ModelDifference kind_difference(const Joint& a, const Joint& b, std::size_t joint) {
  return {.kind = DifferenceKind::joint_kind,
          .joint = static_cast<int>(joint),
          .parameter = "type",
          .what = std::string(name(kind(a))) + " in A, " + name(kind(b)) + " in B"};
}

ModelDifference orientation_difference(const Joint& a, const Joint& b, std::size_t joint) {
  const Rotation between = a.offset.linear().transpose() * b.offset.linear();
  const std::string relation = rotation_relation(a.offset.linear(), b.offset.linear());
  const auto rpy_text = [](const Rotation& rotation) {
    const RollPitchYaw rpy = roll_pitch_yaw(rotation);
    return vector_text({rpy.roll, rpy.pitch, rpy.yaw});
  };
  return {.kind = DifferenceKind::orientation,
          .joint = static_cast<int>(joint),
          .parameter = "orientation",
          .a = 0,
          .b = so3_log(between).norm(),
          .what = "rpy " + rpy_text(a.offset.linear()) + " in A, " + rpy_text(b.offset.linear()) +
                  " in B" + (relation.empty() ? "" : " (" + relation + ")")};
}

/// Adds the differences of one joint's origin and orientation.
void add_offset_differences(const Joint& a, const Joint& b, std::size_t joint, double tolerance,
                            std::vector<ModelDifference>& found) {
  constexpr const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    const double in_a = a.offset.translation()[k], in_b = b.offset.translation()[k];
    if (std::abs(in_a - in_b) <= tolerance) continue;
    found.push_back(parameter_difference(DifferenceKind::length, joint,
                                         std::string("origin ") + names[k], in_a, in_b));
  }
  const Vector3 rotated = so3_log(a.offset.linear().transpose() * b.offset.linear());
  if (rotated.norm() > tolerance) found.push_back(orientation_difference(a, b, joint));
}

}  // namespace

std::vector<Reconciliation> frame_explanations(const Arm& a, const Arm& b, double tolerance) {
  if (a.joints().size() != b.joints().size()) return {};
  Reconciliation explanation(a);
  std::vector<Joint> joints = a.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& other = b.joints()[i];
    Joint& joint = joints[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (kind(joint) != kind(other)) {
      explanation.differences.push_back(kind_difference(joint, other, i));
      joint.screw = other.screw;
    }
    const bool opposite = same_screw(joint.screw, -other.screw, tolerance);
    if (opposite) {
      explanation.gain[k] = -1;
      explanation.differences.push_back(sign_difference(i));
    } else if (!same_screw(joint.screw, other.screw, tolerance)) {
      explanation.differences.push_back(axis_difference(joint, other, i));
      joint.screw = other.screw;
    }
    const Pose motion = joint.offset.inverse(Eigen::Isometry) * other.offset;
    if (same_pose(motion, Pose::Identity(), tolerance)) continue;
    if (const std::optional<double> value = motion_of(joint.screw, motion, tolerance)) {
      explanation.offset[k] = opposite ? *value : -*value;
      explanation.differences.push_back(offset_difference(a, i, explanation.offset[k]));
      continue;
    }
    add_offset_differences(joint, other, i, tolerance, explanation.differences);
    joint.offset = other.offset;
  }
  explanation.arm = {a.name(), joints, a.tool(), a.base()};
  add_end_differences(a, b, tolerance, explanation);
  return {explanation};
}

}  // namespace beeline::internal
