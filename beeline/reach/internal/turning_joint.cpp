#include <algorithm>
#include <cmath>

#include <beeline/math/revolution.h>
#include <beeline/model/internal/dh_row.h>
#include <beeline/reach/internal/turning_joint.h>

namespace beeline::internal {
namespace {

constexpr double tolerance = 1e-12;  // rad

/// The first joint's screw in the world.
Twist first_screw(const Arm& arm) {
  const Joint& first = arm.joints().front();
  return adjoint(arm.base() * first.offset, first.screw);
}

bool along_z(const Twist& screw) { return screw.segment<2>(3).norm() <= tolerance; }

}  // namespace

bool turns_alone(const Arm& arm, int coordinate) {
  const auto follows = [&](const Arm::JointCoupling& coupling) {
    return coupling.coordinate == coordinate;
  };
  return kind(arm.joint_of(coordinate)) == JointKind::revolute &&
         std::count_if(arm.couplings().begin(), arm.couplings().end(), follows) == 1;
}

std::optional<double> TurningJoint::turned(const Limits& limits, double q, double angle) const {
  const double value = q + sign * angle;
  const bool bounded = limits.upper < Limits::none && limits.lower > -Limits::none;
  if (!bounded) return value;
  const double middle = (limits.lower + limits.upper) / 2;
  const double nearest = value + revolution * std::round((middle - value) / revolution);
  if (!within_position_limits(limits, nearest)) return std::nullopt;
  return std::clamp(nearest, limits.lower, limits.upper);
}

double base_tilt(const Arm& arm) {
  const Twist screw = first_screw(arm);
  return std::atan2(screw.segment<2>(3).norm(), std::abs(screw[5]));
}

std::optional<TurningJoint> base_joint(const Arm& arm) {
  if (arm.joints().front().mimic || !turns_alone(arm, 0)) return std::nullopt;
  const Twist screw = first_screw(arm);
  if (!along_z(screw)) return std::nullopt;
  // The velocity of the world's origin is p x w.
  return TurningJoint{.coordinate = 0,
                      .sign = screw[5] > 0 ? 1.0 : -1.0,
                      .axis_point = Vector3(-screw[1], screw[0], 0) / screw[5]};
}

std::optional<TurningJoint> roll_joint(const Arm& arm) {
  const Joint& last = arm.joints().back();
  const int coordinate = arm.dof() - 1;
  if (last.mimic || !turns_alone(arm, coordinate)) return std::nullopt;
  const Twist screw = adjoint(Pose(arm.tool().inverse()), last.screw);  // in the tool frame
  const bool through = screw.head<3>().norm() <= tolerance * length_unit(arm);
  if (!through || !along_z(screw)) return std::nullopt;
  return TurningJoint{.coordinate = coordinate, .sign = screw[5] > 0 ? 1.0 : -1.0};
}

Arm without_limits(const Arm& arm, const TurningJoint& joint) {
  return with_limits(arm, {{arm.joint_of(joint.coordinate).name,
                            {.lower = -Limits::none, .upper = Limits::none}}});
}

}  // namespace beeline::internal
