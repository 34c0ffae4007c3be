#pragma once

#include <beeline/inverse/inverse_kinematics.h>

#include "arguments.h"

/// What is asked of inverse kinematics besides the pose, by `ik` and `batch ik` alike.
struct InverseArgument {
  TaskArgument task;
  std::string seed, lock;
  std::string method = name(beeline::InverseMethod::automatic);
  std::string redundancy = name(beeline::Redundancy::any);
  beeline::InverseOptions options;

  /// --seed and --task, --ignore-limits, --lock and which of many: what is wanted.
  void declare_choices(CLI::App& verb);
  /// --method to --time-limit: how it is looked for.
  void declare_search(CLI::App& verb);
  beeline::InverseOptions read(const beeline::Arm& arm, const UnitArgument& unit) const;
};
