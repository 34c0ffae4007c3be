#pragma once

#include <string>
#include <string_view>

#include <beeline/read/internal/file_stream.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Parses a trajectory in the form of ROS trajectory_msgs/JointTrajectory:
///     {"joint_names": [...],
///      "points": [{"positions": [...], "velocities": [...], "accelerations": [...],
///                  "time_from_start": {"sec": 1, "nanosec": 500000000}}, ...]}
/// Files of version 0.1 have a member `time` of each point, in seconds, which takes precedence.
/// Empty velocities and accelerations mean none, as in ROS; `header` and `effort` are ignored.
/// The memory is that of the numbers and of one point. Throws FileError that names the line and the
/// value.
Trajectory trajectory_from_json(std::string_view text, const std::string& path);
Trajectory trajectory_from_json(InputFile& file);

/// Returns the message with all of its members and no other. Times are rounded to nanoseconds.
/// Throws Error for times that exceed the 32 bits of ROS's seconds, and for two samples within the
/// same nanosecond.
std::string trajectory_to_json(const Trajectory& trajectory);

}  // namespace beeline::internal
