#pragma once

#include <string>
#include <string_view>

#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The format of a trajectory in a file, given by the ending of its path. Numbers read back
/// exactly, times of .json to the nanosecond.
///   .csv   columns t, then the joints' names, and NAME_vel, NAME_acc where known
///   .json  the message trajectory_msgs/JointTrajectory of ROS, times in whole nanoseconds
enum class TrajectoryFormat { csv, json };

/// Throws Error for another ending.
TrajectoryFormat trajectory_format(const std::string& path);

/// Returns the format of a file that was read. A file without an ending, such as a pipe, is .json
/// if its text begins with a brace and otherwise .csv. Throws FileError for another ending.
TrajectoryFormat trajectory_format(const std::string& path, std::string_view text);

/// Returns the content of a file of this format. Throws Error for a trajectory that is not valid
/// (check_trajectory()), has no samples, or whose joints have names that the format cannot hold.
std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format);

/// Writes trajectory_text() to a file, which is replaced as a whole. Throws as trajectory_text(),
/// and FileError when the file cannot be written.
void write_trajectory(const std::string& path, const Trajectory& trajectory);

/// Reads a trajectory of any length, in memory proportional to its numbers;
/// trajectory_format(path, text) gives its format. Throws FileError that names the line and the
/// column or value, or for another ending.
Trajectory read_trajectory(const std::string& path);

/// The same from the text of the file at `path`.
Trajectory parse_trajectory(std::string_view text, const std::string& path);

}  // namespace beeline
