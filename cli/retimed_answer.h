#pragma once

#include <optional>
#include <vector>

#include <beeline/timing/retime.h>

#include "arguments.h"
#include "budget_argument.h"
#include "command/verb.h"
#include "result_files.h"
#include "scene_argument.h"

namespace beeline::command {

/// The last steps of a verb that retimes a path: the proof of its clearance, and its files.
struct RetimedResult {
  const SceneArgument& scene_argument;
  const std::optional<CheckedScene>& scene;
  const BudgetArgument& budget;  ///< of the proof
  const ResultFiles& files;
  const UnitArgument& unit;
  std::vector<Pose> waypoints = {};  ///< of the tool, for pictures

  /// Proves that the motion keeps its clearance, writes the files and reports. `duration_before`:
  /// of the trajectory that was retimed, s, if it had times.
  Answer answer(const Arm& arm, const Retimed& retimed,
                const std::optional<double>& duration_before = std::nullopt) const;
};

}  // namespace beeline::command
