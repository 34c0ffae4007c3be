#pragma once

#include <beeline/budget.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>
#include <beeline/planning/branch.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// The status and reason of a segment that cannot be tracked to its end.
struct SegmentFailure {
  MotionStatus status = MotionStatus::singular;
  Reason reason;  ///< without its segment
};

/// Sets the place of a reason on its segment to the fraction s.
void set_stop(const Segment& segment, double s, Reason& reason);

/// A coordinate that would have to pass one of its limits.
Reason passed_limit(const Arm& arm, int coordinate, bool lower);

/// Determines why the arm cannot continue from configuration q at the fraction s of the segment, by
/// inverse kinematics for the poses just ahead, with and without limits. A reason with a distance
/// or an angle names its pose: the segment's end if that fails in the same way, otherwise the pose
/// just ahead.
SegmentFailure segment_failure(const Arm& arm, const Segment& segment, const Task& task,
                               const Configuration& q, double s, const Budget& budget = {});

SegmentFailure too_many_samples(std::size_t max_samples);

}  // namespace beeline::internal
