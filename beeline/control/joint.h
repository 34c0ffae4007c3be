#pragma once

#include <span>

#include <beeline/control/pid.h>
#include <beeline/control/simulate.h>

namespace beeline {

/// Joint-space motion control from `start` to `goal`, joints on a straight line in joint space when
/// kp alone acts, which is a curve for the tool. Joint values are plain numbers here: no turn is
/// taken the short way round.
/// Throws Error for a gain that is not finite or negative, kp not above zero, or a start that does
/// not fit; a goal outside the limits is answered with `outside_limits`.
ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains = {},
                                const SimulationOptions& options = {});

/// The farthest that any joint went beyond the goal, as a share of its way there; 0 when none did.
double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal);

}  // namespace beeline
