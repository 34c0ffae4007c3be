#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/file.h>
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

/// The same value as JSON; plain scalars are numbers where they can be.
Json json_of(Yaml&& yaml);

}  // namespace beeline::internal
