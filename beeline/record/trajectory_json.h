#pragma once

#include <string>
#include <string_view>

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// As ROS trajectory_msgs/JointTrajectory:
///     {"joint_names": [...],
///      "points": [{"positions": [...], "velocities": [...], "accelerations": [...],
///                  "time_from_start": {"sec": 1, "nanosec": 500000000}, "time": 1.5}, ...]}
/// Nanoseconds round, so `time`, in seconds, is written besides and wins when read; either may be
/// left out. Empty velocities and accelerations count as left out, as in ROS; a message's `header`
/// and `effort` are passed over. Throws FileError naming line and place.
Trajectory trajectory_from_json(std::string_view text, const std::string& path);

/// Throws Error for times beyond ROS's 32 bits of seconds.
std::string trajectory_to_json(const Trajectory& trajectory);

}  // namespace beeline
