#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline {

/// One end of a step along a segment: the arm's configuration, the share of the segment that
/// belongs to it, and how far the tool is from the segment's pose there.
struct StepEnd {
  ConfigurationRef q;
  double s = 0;
  Deviation off = {};
};

/// A bound on how far the tool is from pose_at(segment, s), as far as the task asks, while every
/// joint moves in proportion from one end of the step to the other and s does too. By the triangle
/// inequality from chord_bound(), segment_chord_bound() and the ends; where both bend alike, less:
/// the distance as a vector has d'' = p_1'' - p_2'', and the angle f between the orientations
///     f'' >= -|w_1' - w_2'| - W^2 tan(f/4),   W the most that either turns
/// (see chord_bound(); in the world's axes w' is the acceleration of SO(3), and the shortest turn
/// from one orientation to the other has one direction all along). It falls with the square of the
/// step. Throws Error when a configuration does not fit the arm.
Deviation matched_step_bound(const Arm& arm, const Segment& segment, const Task& task,
                             const StepEnd& a, const StepEnd& b);

/// Throws Error unless matched_step_bound() holds for the task: position rows in the world's axes,
/// or all or none; all orientation rows or none, or that about z for a planar arm and a segment
/// that turns about z alone.
void check_matched(const Arm& arm, const Segment& segment, const Task& task);

}  // namespace beeline
