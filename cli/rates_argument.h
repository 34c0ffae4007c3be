#pragma once

#include <optional>
#include <string>

#include "arguments.h"
#include "command/verb.h"

namespace beeline::command {

/// --rates-of and --damping: the joint rates of a velocity of the tool.
struct RatesArgument {
  std::string text = {};  ///< the velocity; empty: none
  std::optional<double> damping = {};

  std::vector<Option> options();
  /// Adds the rates at q to the answer of `jacobian`, which becomes a no if the arm cannot move its
  /// tool so. `task` has the rows and the frame of the velocity. Warns of each rate above its
  /// limit.
  void add_to(Answer& answer, const Arm& arm, const Configuration& q, const Task& task,
              const UnitArgument& unit) const;
};

}  // namespace beeline::command
