#pragma once

#include <beeline/certificate/path_deviation.h>
#include <beeline/planning/status.h>

namespace beeline {

struct SegmentFailure {
  MotionStatus status = MotionStatus::singular;
  std::string reason;  ///< "stops after 63.1 % of its length, at x y z: ..."
};

/// "stops after 63.1 % of its length, at x y z: ", for the point at the fraction `s` of the
/// segment.
std::string place_in_words(const Segment& segment, double s);

/// "joint joint2 would have to pass its upper limit of 2 rad".
std::string limit_in_the_way(const Arm& arm, int coordinate, bool lower);

/// Why the arm, at configuration q and at the fraction `s` of the segment, cannot move on: asks
/// inverse kinematics for the poses just ahead, with limits and without.
SegmentFailure segment_failure(const Arm& arm, const Segment& segment, const Task& task,
                               const Configuration& q, double s);

/// The answer when a path used up its samples.
SegmentFailure too_many_samples(int most);

}  // namespace beeline
