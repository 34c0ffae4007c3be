#pragma once

#include <string>
#include <string_view>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Parses a trajectory in the form of ROS trajectory_msgs/JointTrajectory:
///     {"joint_names": [...],
///      "points": [{"positions": [...], "velocities": [...], "accelerations": [...],
///                  "time_from_start": {"sec": 1, "nanosec": 500000000}, "time": 1.5}, ...]}
/// `time`, in seconds, is exact, where nanoseconds are rounded; it takes precedence. One of the two
/// suffices. Empty velocities and accelerations mean none, as in ROS; `header` and `effort` are
/// ignored. Throws FileError that names the line and the value.
Trajectory trajectory_from_json(std::string_view text, const std::string& path);

/// Throws Error for times that exceed the 32 bits of ROS's seconds.
std::string trajectory_to_json(const Trajectory& trajectory);

}  // namespace beeline::internal
