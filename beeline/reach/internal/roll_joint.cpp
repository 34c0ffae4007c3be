#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/model/internal/dh_row.h>
#include <beeline/reach/internal/roll_joint.h>

namespace beeline::internal {

std::optional<double> RollJoint::turned(const Arm& arm, double q, double roll) const {
  const Limits& limits = arm.limits(arm.dof() - 1);
  constexpr double revolution = 2 * std::numbers::pi;
  const double value = q + sign * roll;
  const bool bounded = limits.upper < Limits::none && limits.lower > -Limits::none;
  if (!bounded) return value;
  const double middle = (limits.lower + limits.upper) / 2;
  const double nearest = value + revolution * std::round((middle - value) / revolution);
  if (!within_position_limits(limits, nearest)) return std::nullopt;
  return std::clamp(nearest, limits.lower, limits.upper);
}

std::optional<RollJoint> roll_joint(const Arm& arm) {
  const Joint& last = arm.joints().back();
  const int coordinate = arm.dof() - 1;
  if (last.mimic || kind(last) != JointKind::revolute) return std::nullopt;
  const auto follows = [&](const Arm::Drive& drive) { return drive.coordinate == coordinate; };
  if (std::count_if(arm.drives().begin(), arm.drives().end(), follows) != 1) return std::nullopt;
  constexpr double tolerance = 1e-12;
  const Twist screw = adjoint(Pose(arm.tool().inverse()), last.screw);
  const bool through = screw.head<3>().norm() <= tolerance * length_unit(arm);
  const bool along = screw.segment<2>(3).norm() <= tolerance;
  if (!through || !along) return std::nullopt;
  return RollJoint{screw[5] > 0 ? 1.0 : -1.0};
}

Arm with_free_roll(const Arm& arm) {
  return with_limits(arm,
                     {{arm.joints().back().name, {.lower = -Limits::none, .upper = Limits::none}}});
}

}  // namespace beeline::internal
