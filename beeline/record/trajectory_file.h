#pragma once

#include <string>

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Trajectories in files; the format goes by the file's extension, numbers read back exactly.
///   .csv   columns t, then the joints' names, and NAME_vel, NAME_acc where known
///   .json  as ROS trajectory_msgs/JointTrajectory; `time` beside `time_from_start` is exact
/// Throws Error for another extension, and for what check_recordable refuses.
enum class TrajectoryFormat { csv, json };
TrajectoryFormat trajectory_format(const std::string& path);

/// The file's content, in this format.
std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format);

/// Writes beside and renames, as write_file does. Throws Error for joint names that the format
/// cannot tell apart from its own columns.
void write_trajectory(const std::string& path, const Trajectory& trajectory);

/// Throws FileError naming line and column or place.
Trajectory read_trajectory(const std::string& path);

}  // namespace beeline
