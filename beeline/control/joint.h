#pragma once

#include <optional>
#include <span>

#include <beeline/control/controlled_motion.h>
#include <beeline/control/pid.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>

namespace beeline {

/// Joint-space motion control from `start` to `goal`. With kp alone the motion is a straight line
/// in joint space, which is a curve of the tool. Joint values are plain numbers; angles are not
/// wrapped.
/// Throws Error for gains that Pid refuses, and for a start that does not fit the arm or is outside
/// its limits. A goal outside the limits has the status `outside_limits`.
ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains = {},
                                const SimulationOptions& options = {});

struct JointMoveOptions {
  Synchronise synchronise = Synchronise::time;  ///< default: each joint has its own s-curve
  double rate = 100;                            ///< samples per second, at least 0.001
  /// Seconds, a whole number of periods of the rate; default: the shortest that the limits allow.
  std::optional<double> duration = std::nullopt;
  Budget budget = {};
};

/// Moves the joints from rest at `start` to rest at `goal` in minimum time under the limits of
/// velocity, acceleration and jerk, or in options.duration: point_to_point(), sampled(). The start
/// may be outside the position limits by up to 0.1 rad or 0.01 m; the motion leads back in.
/// The status is `outside_limits` for a goal outside the limits and for a duration that is too
/// short, whose reason has the shortest one. Throws Error for a start farther outside, a
/// configuration that does not fit the arm, and a duration of no whole number of periods.
ControlledMotion move_joints(const Arm& arm, const Configuration& start, const Configuration& goal,
                             const JointMoveOptions& options = {});

/// Returns the largest distance of any joint beyond the goal, relative to its distance from the
/// first sample to the goal; 0 when no joint overshoots.
double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal);

}  // namespace beeline
