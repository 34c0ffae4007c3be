#include <cmath>
#include <numbers>
#include <random>

#include <beeline/doctor/internal/number_relation.h>
#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

/// Draws coordinates in +-3 rad or +-1 m that are the same with each standard library.
Configuration draw(const Arm& arm, std::mt19937_64& engine) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const double unit = static_cast<double>(engine() >> 11) * 0x1p-52 - 1;
    q[k] = unit * (kind(arm.joint_of(k)) == JointKind::prismatic ? 1 : 3);
  }
  return q;
}

double exact_angle(double angle, double tolerance) {
  constexpr double step = std::numbers::pi / 12;
  const double multiple = std::round(angle / step);
  if (std::abs(angle - multiple * step) > tolerance) return angle;
  return std::abs(multiple) == 12 ? std::numbers::pi : multiple * step;
}

std::string in_brackets(const std::string& clause) {
  return clause.empty() ? "" : " (" + clause + ")";
}

}  // namespace

Deviation deviation(const Reconciliation& explanation, const Arm& b, int count) {
  std::mt19937_64 engine(20240229);
  Deviation largest;
  for (int i = 0; i < count; ++i) {
    const Configuration q = draw(explanation.arm, engine);
    const Pose from_a =
        explanation.mount * forward_kinematics(explanation.arm, q) * explanation.tcp;
    const Configuration other = explanation.gain.cwiseProduct(q) + explanation.offset;
    const Twist difference = pose_difference(forward_kinematics(b, other), from_a);
    largest.position = std::max(largest.position, difference.head<3>().norm());
    largest.orientation = std::max(largest.orientation, difference.tail<3>().norm());
  }
  return largest;
}

bool negligible(const Deviation& deviation, const Arm& b, double tolerance) {
  const double joints = static_cast<double>(b.joints().size()) + 2;
  double size = std::max(b.base().translation().norm(), b.tool().translation().norm());
  for (const Joint& joint : b.joints()) size = std::max(size, joint.offset.translation().norm());
  return deviation.orientation <= joints * tolerance &&
         deviation.position <= joints * tolerance * std::max(1.0, joints * size);
}

Arm bare(const Arm& arm) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.limits = {};
    joint.mimic.reset();
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

std::string joint_text(const Arm& arm, std::size_t joint) {
  const std::string number = std::to_string(joint + 1);
  const std::string& name = arm.joints()[joint].name;
  return "joint " + number + (name == "joint" + number ? "" : " (" + name + ")");
}

std::string number_list(const Vector3& v, const std::string& separator) {
  std::string text;
  for (const double value : v) {
    text += (text.empty() ? "" : separator) + number(std::abs(value) < 5e-10 ? 0 : value);
  }
  return text;
}

bool same_pose(const Pose& a, const Pose& b, double tolerance) {
  const Twist difference = pose_difference(a, b);
  return difference.head<3>().norm() <= tolerance && difference.tail<3>().norm() <= tolerance;
}

std::optional<double> motion_of(const Twist& screw, const Pose& motion, double tolerance) {
  const bool slides = screw.tail<3>().isZero(0);
  const double value = slides ? screw.head<3>().dot(motion.translation())
                              : screw.tail<3>().dot(so3_log(motion.linear()));
  if (!same_pose(screw_motion(screw, value), motion, tolerance)) return std::nullopt;
  return value;
}

Pose without_rounding(const Pose& pose, double tolerance) {
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  const Vector3 position = (pose.translation() * 1e9).array().round() / 1e9;
  return make_pose(position, rotation(RollPitchYaw{exact_angle(rpy.roll, tolerance),
                                                   exact_angle(rpy.pitch, tolerance),
                                                   exact_angle(rpy.yaw, tolerance)}));
}

std::string pose_argument(const Pose& pose) {
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  const Vector3 angles(rpy.roll, rpy.pitch, rpy.yaw);
  const std::string position = number_list(pose.translation(), ",");
  return angles.isZero(1e-9) ? position : position + "," + number_list(angles, ",");
}

ModelDifference mount_difference(const Pose& mount) {
  return {.kind = DifferenceKind::mount,
          .pose = mount,
          .what = "B stands elsewhere in the world",
          .remedy = "mount A at " + pose_argument(mount)};
}

ModelDifference tool_difference(const Pose& tcp) {
  return {.kind = DifferenceKind::tool,
          .pose = tcp,
          .what = "B has another tool frame",
          .remedy = "give A the tool centre point " + pose_argument(tcp)};
}

ModelDifference offset_difference(const Arm& a, std::size_t joint, double offset) {
  const std::string q = "q" + std::to_string(joint + 1);
  const std::string sign = offset < 0 ? " - " : " + ";
  return {.kind = DifferenceKind::joint_offset,
          .joint = static_cast<int>(joint),
          .parameter = "offset",
          .a = 0,
          .b = offset,
          .what = "zero elsewhere by " + with_unit(a.joints()[joint], offset),
          .remedy = q + " of B = " + q + " of A" + sign + number(std::abs(offset))};
}

ModelDifference sign_difference(std::size_t joint) {
  const std::string q = "q" + std::to_string(joint + 1);
  return {.kind = DifferenceKind::joint_sign,
          .joint = static_cast<int>(joint),
          .parameter = "sign",
          .a = 1,
          .b = -1,
          .what = "opposite sign",
          .remedy = q + " of B = -" + q + " of A"};
}

ModelDifference parameter_difference(DifferenceKind kind, std::size_t joint,
                                     const std::string& dimension, double in_a, double in_b,
                                     const std::string& where) {
  const bool length = kind == DifferenceKind::length;
  const auto text = [&](double value) { return length ? number(value) + " m" : angle(value); };
  const std::string parameter = dimension + where;
  return {.kind = kind,
          .joint = static_cast<int>(joint),
          .parameter = parameter,
          .dimension = dimension,
          .a = in_a,
          .b = in_b,
          .what = parameter + " " + text(in_a) + " in A, " + text(in_b) + " in B" +
                  in_brackets(length ? length_relation(in_a, in_b) : angle_relation(in_a, in_b))};
}

void add_end_differences(const Arm& a, const Arm& b, double tolerance,
                         Reconciliation& explanation) {
  const Pose mount = without_rounding(b.base() * a.base().inverse(Eigen::Isometry), tolerance);
  const Pose tcp = without_rounding(a.tool().inverse(Eigen::Isometry) * b.tool(), tolerance);
  if (!same_pose(mount, Pose::Identity(), tolerance)) {
    explanation.mount = mount;
    explanation.differences.push_back(mount_difference(mount));
  }
  if (!same_pose(tcp, Pose::Identity(), tolerance)) {
    explanation.tcp = tcp;
    explanation.differences.push_back(tool_difference(tcp));
  }
}

}  // namespace beeline::internal
