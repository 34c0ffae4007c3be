#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

#include "command/option.h"

namespace beeline::command {

/// --path and --blend: the path of the tool through the poses.
struct PathArgument {
  std::string kind = "line";
  std::optional<double> blend = {};

  /// The options; `methods` are the values of --method that they require.
  std::vector<Option> options(const std::vector<std::string>& methods = {});
  /// Whether the path is straight lines with a stop at each pose.
  bool straight() const;
  /// Throws Error for options that exclude each other, and for poses that do not make such a path.
  Route through(std::span<const Pose> poses) const;
  /// The path that begins at the tool's pose. For straight lines, that pose becomes the first one.
  /// For other paths it replaces the first pose if it is within 1e-5 m and rad of it in the task's
  /// components, and otherwise becomes an additional first one.
  Route from(const Pose& tool, std::vector<Pose> poses, const Task& task) const;

 private:
  Route route(std::span<const Pose> poses, bool start_first) const;
};

}  // namespace beeline::command
