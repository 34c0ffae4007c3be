#pragma once

#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/planning/status.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// A motion simulated with a feedback controller, or planned by move_joints().
struct ControlledMotion {
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};                 ///< none when reached
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
  int max_steps = 100'000;  ///< of the whole motion, 1 to 1e7; else not_converged
  double time_step = 0.02;  ///< of the controller, seconds, above 0
  Budget budget = {};       ///< of the whole motion
};

}  // namespace beeline
