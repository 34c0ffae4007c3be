#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// Translation and rotation of a line in the rows that the task constrains.
struct LineExtent {
  Vector3 translation,
      rotation;       ///< world axes; zero where the task leaves all rows of the kind free
  double length = 0;  ///< metres; for tasks in base axes of the constrained rows only
  double angle = 0;   ///< radians
  /// Which of the two determines the nearest point: see min_metres_per_radian.
  bool by_position() const { return length > nothing && length >= min_metres_per_radian * angle; }
  bool by_rotation() const { return !by_position() && angle > nothing; }

  static constexpr double nothing = 1e-12;  // metres or radians that count as zero
};
LineExtent extent_of(const Line& line, const Task& task);

/// The component of a vector in the position rows that the task constrains, for a tool at `pose`;
/// in world axes, or in tool axes for a task in tool axes that leaves some of them free.
Vector3 in_position_rows(const Task& task, const Pose& pose, const Vector3& v);

/// Whether a rotation has no component in the orientation rows that the task leaves free. True for
/// planar arms.
bool rotates_within_rows(const Task& task, const Vector3& rotation);

/// The fraction of the line, from 0 to 1, at which its pose is nearest to `pose`: by position, or
/// by orientation for a line that translates less than min_metres_per_radian. 1 for a line that
/// does not move in the constrained rows.
double nearest_fraction(const Line& line, const Pose& pose, const Task& task);

/// The pose of the line at that fraction.
Pose nearest_on(const Line& line, const Pose& pose, const Task& task);

/// The deviation of `pose` from the nearest point of the line, in the constrained rows: the
/// distance from the segment, and the angle to the line's orientation at that point.
Deviation deviation_from(const Line& line, const Pose& pose, const Task& task);

}  // namespace beeline::internal
