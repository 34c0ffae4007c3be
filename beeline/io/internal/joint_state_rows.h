#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/file.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Whether the text begins as a table of messages whose rows have the joints' names: as
/// `rostopic echo -p` prints sensor_msgs/JointState, with columns such as field.name0 and
/// field.position0, or as `ros2 topic echo --csv` does, without a header.
bool begins_with_joint_state_rows(std::string_view text);

/// Reads such messages as recording_from_joint_states(). Velocities are not read, with a note, if
/// rows without a header have two numbers for each joint, as the second may be an effort. Throws
/// FileError for rows of other messages, which says how these are recorded to be read.
Recording recording_from_joint_state_rows(std::string_view text, const std::string& path);
Recording recording_from_joint_state_rows(InputFile& file);

}  // namespace beeline::internal
