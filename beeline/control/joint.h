#pragma once

#include <span>

#include <beeline/control/controlled_motion.h>
#include <beeline/control/pid.h>
#include <beeline/error.h>

namespace beeline {

/// Joint-space motion control from `start` to `goal`. With kp alone the motion is a straight line
/// in joint space, which is a curve of the tool. Joint values are plain numbers; angles are not
/// wrapped.
/// Throws Error for gains that Pid refuses, and for a start that does not fit the arm or is outside
/// its limits. A goal outside the limits has the status `outside_limits`.
ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains = {},
                                const SimulationOptions& options = {});

/// Returns the largest distance of any joint beyond the goal, relative to its distance from the
/// first sample to the goal; 0 when no joint overshoots.
double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal);

}  // namespace beeline
