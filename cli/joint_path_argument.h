#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/planning/free_path.h>

#include "profile_argument.h"
#include "recording_argument.h"

namespace beeline::command {

/// Of `move`: how a motion follows a path in joint space, through given configurations (--through)
/// or around obstacles.
struct JointPathArgument {
  static constexpr double default_rate = 100;  ///< samples per second, without --duration

  std::string through = {};  ///< file of the configurations
  RecordingArgument recording = {};
  std::optional<double> joint_blend = std::nullopt, tool_speed = std::nullopt;
  std::optional<double> duration = std::nullopt, rate = std::nullopt;
  ProfileArgument profile = {};

  /// --through and how its file is read, --joint-blend, --profile, --tool-speed, --duration and
  /// --rate, for --method quickest or another one that moves along paths.
  std::vector<Option> options(const std::string& quickest, const std::string& other);
  /// The configurations of --through.
  std::vector<Configuration> waypoints(const Arm& arm, const UnitArgument& unit) const;
  RetimeOptions through_options() const;
  void set_on(FreeMotionOptions& options) const;
  /// Throws Error for an option of paths without --through, which the quickest motion needs.
  void refuse_without_through() const;
};

}  // namespace beeline::command
