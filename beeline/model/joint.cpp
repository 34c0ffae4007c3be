#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/model/internal/axis_direction.h>
#include <beeline/model/joint.h>

namespace beeline {
namespace {

/// Smaller pitches, in metres per radian and per metre of |v| of the screw, are rounding.
constexpr double smallest_pitch = 1e-12;

Vector3 direction(const Vector3& axis) {
  if (!internal::has_direction(axis)) throw Error(internal::no_direction(axis));
  return axis / axis.stableNorm();
}

}  // namespace

bool internal::has_direction(const Vector3& axis) {
  const double length = axis.stableNorm();
  return length > 1e-9 && std::isfinite(length);
}

std::string internal::no_direction(const Vector3& axis) {
  return "axis " + number(axis.x()) + " " + number(axis.y()) + " " + number(axis.z()) +
         " has no direction; give a vector of non-zero length";
}

Limits overridden(const Limits& limits, const LimitOverrides& overrides) {
  return {.lower = overrides.lower.value_or(limits.lower),
          .upper = overrides.upper.value_or(limits.upper),
          .velocity = overrides.velocity.value_or(limits.velocity),
          .acceleration = overrides.acceleration.value_or(limits.acceleration),
          .jerk = overrides.jerk.value_or(limits.jerk),
          .speed_scale = limits.speed_scale};
}

JointKind kind(const Joint& joint) {
  if (joint.screw.tail<3>().isZero(0)) return JointKind::prismatic;
  return pitch(joint) != 0 ? JointKind::helical : JointKind::revolute;
}

char letter(JointKind kind) { return "RPH"[static_cast<int>(kind)]; }

std::string name(JointKind kind) {
  constexpr internal::EnumNames<JointKind> names("joint kind");
  return names.of(kind);
}

const char* unit(const Joint& joint) { return kind(joint) == JointKind::prismatic ? "m" : "rad"; }

std::string with_unit(const Joint& joint, double value) {
  return kind(joint) == JointKind::prismatic ? number(value) + " m" : angle(value);
}

double pitch(const Joint& joint) {
  const Vector3 v = joint.screw.head<3>();
  const double pitch = v.dot(joint.screw.tail<3>());
  return std::abs(pitch) > smallest_pitch * std::max(1.0, v.norm()) ? pitch : 0;
}

Twist rotation_screw(const Vector3& axis, const Vector3& point, double pitch) {
  const Vector3 w = direction(axis);
  Twist screw;
  screw << point.cross(w) + pitch * w, w;
  return screw;
}

Twist translation_screw(const Vector3& axis) {
  Twist screw;
  screw << direction(axis), Vector3::Zero();
  return screw;
}

Joint with_link_frame(Joint joint, const Pose& link_T_frame) {
  // offset exp(S q) M == (offset M) exp(Ad(M^-1) S q)
  joint.offset = joint.offset * link_T_frame;
  joint.screw = adjoint(link_T_frame.inverse(), joint.screw);
  return joint;
}

Pose screw_motion(const Twist& unit_screw, double q) {
  const Vector3 v = unit_screw.head<3>();
  const Vector3 w = unit_screw.tail<3>();
  Pose motion = Pose::Identity();
  if (w.isZero(0)) {
    motion.translation() = q * v;
    return motion;
  }
  const double sine = std::sin(q);
  const double half = std::sin(q / 2);
  const Eigen::Matrix3d w_hat = hat(w);
  const Eigen::Matrix3d rotation = sine * w_hat + (2 * half * half) * w_hat * w_hat;  // R - I
  motion.linear() += rotation;
  motion.translation() = -rotation * w.cross(v) + (w.dot(v) * q) * w;
  return motion;
}

Twist joint_velocity(const Joint& joint, const Pose& world_T_link, const Vector3& point) {
  Twist velocity = adjoint(world_T_link, joint.screw);
  velocity.head<3>() += velocity.tail<3>().cross(point);
  return velocity;
}

Pose joint_transform(const Joint& joint, double q) {
  return joint.offset * screw_motion(joint.screw, q);
}

}  // namespace beeline
