#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

/// --path and --round: what the tool does between the poses.
struct PathArgument {
  std::string kind = "line";
  std::optional<double> round;

  std::vector<const CLI::Option*> declare(CLI::App& verb, const std::string& before = "");
  /// Straight lines with a stop at each pose.
  bool straight() const;
  /// Throws Error for what does not go together, and poses that do not make such a path.
  beeline::Route through(std::span<const beeline::Pose> poses) const;
  /// The same from the tool's pose on, which is put before the first; for straight lines always,
  /// for others unless that is no more than 1e-5 m and rad away, as far as the task asks. Then it
  /// takes the first one's place, but for what is rounding.
  beeline::Route from(const beeline::Pose& tool, std::vector<beeline::Pose> poses,
                      const beeline::Task& task) const;
};
