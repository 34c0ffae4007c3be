#pragma once

#include <functional>

#include <beeline/error.h>
#include <beeline/planning/status.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// A motion simulated with a feedback controller.
struct ControlledMotion {
  MotionStatus status = MotionStatus::reached;
  std::string reason;                 ///< one sentence; empty when reached
  Trajectory trajectory;              ///< every step, also when the goal was not reached
  std::vector<std::size_t> arrivals;  ///< the sample at which each goal was reached
  int steps = 0;
  int slowed = 0;        ///< steps that were scaled down for the velocity limits
  double overshoot = 0;  ///< largest distance beyond a goal, relative to the distance to it
  double error = 0;      ///< remaining error of the last goal, radians or metres

  explicit operator bool() const { return status == MotionStatus::reached; }
};

struct SimulationOptions {
  double tolerance = 1e-6;  ///< max error of a goal that is reached, metres and radians, above 0
  int max_steps = 100'000;  ///< of the whole motion, 1 or more; else not_converged
  double time_step = 0.02;  ///< of the controller, seconds, above 0
};

/// A controller in joint space.
struct ControlLaw {
  std::function<double(const Configuration& q)> error;        ///< remaining error at q
  std::function<Configuration(const Configuration& q)> step;  ///< change of q in one time step
};

/// Throws Error unless the tolerance and the time step are above zero and there is a step.
void check_options(const SimulationOptions& options);

/// Returns a motion that consists of its start. Throws Error when `start` does not fit the arm or
/// is outside its limits.
ControlledMotion begin_motion(const Arm& arm, const Configuration& start);

/// Simulates q ← q + step(q) from the motion's last sample until the error and the step are within
/// the tolerance, and appends each step to the motion. A step that exceeds velocity limits is
/// scaled down as a whole, which keeps its direction. Returns whether the goal was reached; stops
/// with a status and a reason when a step would leave the joint limits, the error diverges, the
/// error stagnates, or `max_steps` are done.
bool simulate(const Arm& arm, const ControlLaw& law, const SimulationOptions& options,
              ControlledMotion& motion);

}  // namespace beeline
