#include <algorithm>
#include <cmath>

#include <beeline/math/revolution.h>
#include <beeline/trajectory/internal/continuous_joint.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {
namespace {

using internal::revolution;

/// The mean velocity of coordinate k up to sample i; 0 beyond the samples, and for a large step,
/// which may be a jump.
double velocity_up_to(const Trajectory& trajectory, int k, std::size_t i) {
  if (i == 0 || i >= trajectory.size()) return 0;
  const double step = trajectory.positions[i][k] - trajectory.positions[i - 1][k];
  if (std::abs(step) > revolution / 8) return 0;
  return std::abs(step) / (trajectory.times[i] - trajectory.times[i - 1]);
}

/// The difference between the largest and the smallest value of coordinate k.
double range_of(const Trajectory& trajectory, int k) {
  double smallest = Limits::none, largest = -Limits::none;
  for (const Configuration& q : trajectory.positions) {
    smallest = std::min(smallest, q[k]);
    largest = std::max(largest, q[k]);
  }
  return largest - smallest;
}

/// Takes the revolutions of the sensor from coordinate k and reports them; no wraps: none was
/// taken.
UnwrappedJoint unwrap(const Arm& arm, int k, const Trajectory& recorded, Trajectory& trajectory) {
  constexpr double jitter = 1.1;  // of measured times and positions
  UnwrappedJoint joint{.joint = arm.joint_of(k).name};
  // A recording is not subject to a speed scale.
  const double limit = velocity_limit_of(arm.limits(k)) / arm.limits(k).speed_scale;
  // The values of a sensor stay within the one or two revolutions by which it wraps.
  constexpr double max_turns = 2, slack = 0.01;
  const double range = (range_of(recorded, k) - slack) / revolution;
  double turns = 0;
  for (std::size_t i = 1; i < recorded.size(); ++i) {
    const double step = recorded.positions[i][k] - recorded.positions[i - 1][k];
    const double duration = recorded.times[i] - recorded.times[i - 1];
    const double remainder = std::remainder(step, revolution);
    const double nearby =
        jitter * std::max(velocity_up_to(recorded, k, i - 1), velocity_up_to(recorded, k, i + 1));
    const double allowed = std::abs(remainder) > revolution / 8 ? limit : std::max(limit, nearby);
    const double wrapped = std::round((step - remainder) / revolution);
    const bool wraps = wrapped != 0 && std::abs(wrapped) <= max_turns && range <= std::abs(wrapped);
    if (wraps && std::abs(step) > limit * duration && std::abs(remainder) <= allowed * duration) {
      turns -= wrapped;
      if (joint.wraps++ == 0) joint.first_time = recorded.times[i];
    }
    if (turns != 0) trajectory.positions[i][k] += turns * revolution;
  }
  return joint;
}

}  // namespace

Unwrapped unwrapped(const Arm& arm, const Trajectory& trajectory) {
  const Trajectory recorded = matched_to(arm, trajectory);
  Unwrapped result{recorded, {}};
  for (int k = 0; k < arm.dof(); ++k) {
    if (!internal::is_continuous(arm, k)) continue;
    const UnwrappedJoint joint = unwrap(arm, k, recorded, result.trajectory);
    if (joint.wraps > 0) result.joints.push_back(joint);
  }
  return result;
}

}  // namespace beeline
