#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/comment.h>
#include <beeline/io/text/internal/yaml.h>
#include <beeline/io/text/json.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Parses the message of trajectory_from_json() in YAML, as ROS prints it: also as the member
/// `trajectory` of a goal or the `joint_trajectory` of MoveIt, and before a line `---`. A text in
/// braces, as trajectory_to_json() writes it, is of any size; another one has at most 4 MiB and
/// 300,000 values. Throws FileError that names the line and the value.
Trajectory trajectory_from_yaml(std::string_view text, const std::string& path);
Trajectory trajectory_from_yaml(InputFile& file);

/// Returns the comments of a YAML text, lines of their own or behind values, of its first 64 KiB.
std::vector<Comment> yaml_comments(std::string_view text);

/// Whether the text begins with the message of trajectory_from_yaml() without braces: whether the
/// keys `joint_names` and `points` begin lines of it.
bool begins_with_trajectory(std::string_view text);

/// The same value as JSON; plain scalars are numbers where they can be.
Json json_of(Yaml&& yaml);

}  // namespace beeline::internal
