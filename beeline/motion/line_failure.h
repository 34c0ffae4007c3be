#pragma once

#include <beeline/motion/status.h>
#include <beeline/motion/straightness.h>

namespace beeline {

struct LineFailure {
  MotionStatus status = MotionStatus::singular;
  std::string reason;  ///< "stops after 63.1 % of its length, at x y z: ..."
};

/// "stops after 63.1 % of its length, at x y z: ", for the point at the fraction `s` of the line.
std::string line_place(const Line& line, double s);

/// "joint joint2 would have to pass its upper limit of 2 rad".
std::string limit_in_the_way(const Arm& arm, int coordinate, bool lower);

/// Why the arm, at configuration q and at the fraction `s` of the line, cannot move on: asks
/// inverse kinematics for the poses just ahead, with limits and without.
LineFailure line_failure(const Arm& arm, const Line& line, const Task& task, const Configuration& q,
                         double s);

/// The answer when a line used up its samples.
LineFailure too_many_samples(int most);

}  // namespace beeline
