#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Whether the text begins with a message sensor_msgs/JointState of ROS in YAML: whether the keys
/// `name` and `position` are in its first document.
bool begins_with_joint_state(std::string_view text);

/// Reads messages sensor_msgs/JointState in YAML, separated by lines `---`, as `ros2 topic echo`
/// and `rostopic echo` print them: a sample for each, at the time of its header's stamp; times
/// since 1970 count from the first; JointStateReader. Holds the numbers and one message of at most
/// 1 MiB in memory. Throws FileError that names the line and the value.
Recording recording_from_joint_states(std::string_view text, const std::string& path);
Recording recording_from_joint_states(InputFile& file);

}  // namespace beeline::internal
