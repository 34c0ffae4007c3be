#pragma once

#include <optional>
#include <span>
#include <string>

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// Throws Error unless step_bound() holds for the task. Along a line any task is valid, because
/// line_step_bound() bounds the deviation from the nearest point in any rows. Along other segments
/// the deviation is measured from the pose at s, and matched_step_bound() bounds the distance of
/// two positions and the angle between two orientations. These bound any position rows in base
/// axes and all orientation rows together (for a planar arm the row about z), and check_matched()
/// accepts tasks of these rows. interval_deviation() holds for every task.
void check_task(const Arm& arm, const Segment& segment, const Task& task);

/// Does the same for every segment. Throws Error for a path without segments.
void check_task(const Arm& arm, const ToolPath& path, const Task& task);

/// Does the same for the route's path. Throws Error unless the route has a span and a stop for each
/// of its segments.
void check_route(const Arm& arm, const Route& route, const Task& task);

/// Throws Error if no task is given and the path leaves the plane of a planar arm.
void check_in_plane(const Arm& arm, const ToolPath& path, const std::optional<Task>& task);

/// Returns the name of the end of segment i: `waypoint 2` on unnamed lines, else `the end of move 3
/// (line)`.
std::string segment_end_name(const ToolPath& path, std::size_t i);

/// Throws Error unless the path parameters are on the path and do not decrease.
void check_path_parameters(const ToolPath& path, std::span<const double> path_parameters);

bool all_lines(const ToolPath& path);

/// Whether the tool, the segment's poses and the rotations between them rotate only about the
/// world's z axis, to 1e-9 rad.
bool all_rotate_about_z(const Arm& arm, const Segment& segment);

/// Whether the segment's pose is constant in the rows of the task, to 1e-9 m and rad.
bool stands_still(const Segment& segment, const Task& task);

}  // namespace beeline::internal
