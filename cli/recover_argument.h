#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/trajectory/limit_usage.h>

#include "arguments.h"
#include "command/option.h"

namespace beeline::command {

/// --recover: how far a motion may start outside the position limits.
struct RecoverArgument {
  std::string text = {};

  /// `of` says what starts there, and what follows.
  Option option(const std::string& of, const OptionRules& rules = {});
  bool given() const { return !text.empty(); }
  /// The largest excess, rad or m; 0 without the option.
  double read(const Arm& arm, const UnitArgument& unit) const;
};

/// The pose of the tool after the recovery of a motion that begins at `start`.
Pose tool_after_recovery(const Arm& arm, const Configuration& start);

/// The beginning of a motion outside the limits: a line of the report, and null or an object.
std::string recovery_text(const Arm& arm, const std::optional<Recovery>& recovery,
                          const UnitArgument& unit);
Json json_recovery(const Arm& arm, const std::optional<Recovery>& recovery,
                   const UnitArgument& unit);

}  // namespace beeline::command
