#pragma once

#include <beeline/motion/status.h>
#include <beeline/motion/straightness.h>

namespace beeline {

struct LineFailure {
  MotionStatus status = MotionStatus::singular;
  std::string reason;  ///< "stops after 63.1 % of its length, at x y z: ..."
};

/// Why the arm, at configuration q and at the fraction `u` of the line's time, cannot move on: asks
/// inverse kinematics for the poses just ahead, with limits and without.
LineFailure line_failure(const Arm& arm, const Line& line, const Task& task, const Configuration& q,
                         double u);

/// The answer when a line used up its samples.
LineFailure too_many_samples(int most);

}  // namespace beeline
