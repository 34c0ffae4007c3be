#pragma once

#include <beeline/inverse/inverse_kinematics.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "pose_argument.h"

namespace beeline::command {

/// The options of inverse kinematics that `ik` and `batch ik` share.
struct InverseArgument {
  TaskArgument task = {};
  WorkArgument work = {};
  std::string seed = {}, lock = {}, pose_tolerance = {}, weights = {};
  std::string method = name(InverseMethod::automatic);
  std::string redundancy = {};
  InverseOptions values = {};
  BudgetArgument budget = {};

  /// The options that select solutions: --work, --seed, --task, --ignore-limits, --lock,
  /// --redundancy, --pose-tolerance, --weights, --grid.
  std::vector<Option> choice_options();
  /// The options of the search: --method to --random-seed.
  std::vector<Option> search_options();
  InverseOptions read(const Arm& arm, const ArmArgument& argument, const UnitArgument& unit) const;
};

}  // namespace beeline::command
