#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline {

/// A line as far as the task asks.
struct LineExtent {
  Vector3 way, turn;  ///< in the world's axes; zero when no row of the kind matters
  double length = 0;  ///< metres; in base axes of the rows that matter alone
  double angle = 0;   ///< radians
  bool told_by_way() const { return length > nothing && length >= least_metres_per_radian * angle; }
  bool told_by_turn() const { return !told_by_way() && angle > nothing; }

  static constexpr double nothing = 1e-12;  // metres or radians that count as none
};
LineExtent extent_of(const Line& line, const Task& task);

/// The way that a vector has in the position rows that matter, for a tool at `pose`: in the world's
/// axes, or in the tool's for a task in these that leaves some free.
Vector3 in_position_rows(const Task& task, const Pose& pose, const Vector3& v);

/// Whether nothing of a turn is in rows that do not matter: so it is for planar arms.
bool turns_within_rows(const Task& task, const Vector3& turn);

/// The fraction of the line, from 0 to 1, whose pose is nearest: nearest is meant by position, and
/// by orientation where the line moves less than `least_metres_per_radian`. 1 for a line that does
/// neither.
double nearest_fraction(const Line& line, const Pose& pose, const Task& task);

/// The line's pose at that fraction.
Pose nearest_on(const Line& line, const Pose& pose, const Task& task);

/// How far `pose` is from the nearest point of the line: the distance to the segment and the turn
/// to the line's orientation at that point, as far as the task asks.
Deviation deviation_from(const Line& line, const Pose& pose, const Task& task);

}  // namespace beeline
