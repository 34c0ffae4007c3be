#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// One end of a step along a segment.
struct StepEnd {
  ConfigurationRef q;
  double s = 0;              ///< parameter of the segment at q, in [0, 1]
  Deviation deviation = {};  ///< deviation of the tool at q from the segment's pose at s
};

/// Bounds the deviation of the tool from pose_at(segment, s), in the rows of the task, while the
/// configuration and s move linearly from `a` to `b`.
///
/// With chord_bound() for the tool (p_1, w_1) and segment_chord_bound() for the segment (p_2, w_2),
/// the triangle inequality gives the sum of both bounds and the larger deviation at the ends. If
/// the curvatures agree, the difference of the motions is smaller: d'' = p_1'' - p_2'' for
/// positions, and for the angle f between the orientations
///     f'' >= -|w_1' - w_2'| - W^2 tan(f/4),   W the larger integral of |w|,
/// as in orientation_gap() (in world axes w' is the acceleration in SO(3), and a shortest rotation
/// has a constant axis). The result is the smaller of the two bounds, and is proportional to the
/// square of the step. Throws Error when a configuration does not fit the arm.
Deviation matched_step_bound(const Arm& arm, const Segment& segment, const Task& task,
                             const StepEnd& a, const StepEnd& b);

/// Throws Error unless matched_step_bound() holds for the task. The task must have all orientation
/// rows or none; for a planar arm and a segment that rotates about z only, the z row alone is
/// enough. It must have all position rows or none, or any position rows in world axes.
void check_matched(const Arm& arm, const Segment& segment, const Task& task);

}  // namespace beeline::internal
