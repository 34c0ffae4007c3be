#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

#include "command/option.h"

/// --path and --blend: the path of the tool through the poses.
struct PathArgument {
  std::string kind = "line";
  std::optional<double> blend = {};

  /// The options; `methods` are the values of --method that they require.
  std::vector<Option> options(const std::vector<std::string>& methods = {});
  /// Whether the path is straight lines with a stop at each pose.
  bool straight() const;
  /// Throws Error for options that exclude each other, and for poses that do not make such a path.
  beeline::Route through(std::span<const beeline::Pose> poses) const;
  /// The path that begins at the tool's pose. For straight lines, that pose becomes the first one.
  /// For other paths it replaces the first pose if it is within 1e-5 m and rad of it in the task's
  /// components, and otherwise becomes an additional first one.
  beeline::Route from(const beeline::Pose& tool, std::vector<beeline::Pose> poses,
                      const beeline::Task& task) const;

 private:
  beeline::Route route(std::span<const beeline::Pose> poses, bool start_first) const;
};
