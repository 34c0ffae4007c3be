#pragma once

#include <functional>

#include <beeline/planning/status.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// A motion made by a controller step by step, and how it went.
struct ControlledMotion {
  MotionStatus status = MotionStatus::reached;
  std::string reason;                 ///< one sentence; empty when reached
  Trajectory trajectory;              ///< every step, also when the goal was not reached
  std::vector<std::size_t> arrivals;  ///< the sample at which each goal was reached
  int steps = 0;
  int slowed = 0;        ///< steps that were scaled down to keep the arm's velocity limits
  double overshoot = 0;  ///< farthest beyond a goal, as a share of the way to it
  double error = 0;      ///< what is left to the last goal
};

struct SimulationOptions {
  double tolerance = 1e-6;  ///< the error at which a goal counts as reached, metres and radians
  int max_steps = 100'000;  ///< over the whole motion
  double time_step = 0.02;  ///< seconds that a step takes
};

/// A law in joint space: what is left, and the step that it asks for, at a configuration.
struct ControlLaw {
  std::function<double(const Configuration& q)> error;
  std::function<Configuration(const Configuration& q)> step;
};

/// Throws Error for a tolerance or time step that is not above zero, or fewer than one step.
void check_options(const SimulationOptions& options);

/// The motion before the first step. Throws Error when `start` does not fit or is outside limits.
ControlledMotion begin_motion(const Arm& arm, const Configuration& start);

/// Runs q <- q + step(q) from the motion's last sample until the error and the step asked for are
/// within tolerance, and appends each step. A step that would exceed velocity limits is scaled down
/// as a whole, so its direction stays. Stops with a reason when a step would leave the joint
/// limits, the error grows without bound, the error stands still, or the steps are used up; true
/// when it arrived.
bool simulate(const Arm& arm, const ControlLaw& law, const SimulationOptions& options,
              ControlledMotion& motion);

}  // namespace beeline
