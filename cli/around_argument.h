#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/planning/free_path.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "command/verb.h"
#include "joint_path_argument.h"
#include "result_files.h"
#include "scene_argument.h"

namespace beeline::command {

/// --method around of `move`: a motion that goes around obstacles.
struct AroundArgument {
  static constexpr const char* method = "around";

  std::string pose = {};  ///< the goal as a pose
  FreeMotionOptions motion = {};

  std::vector<Option> options();

  /// Plans, proves and writes the motion from a configuration to another or, if that is not
  /// given, to one of the solutions of inverse kinematics for the pose.
  Answer answer(const Arm& arm, const Configuration& from, const std::optional<Configuration>& to,
                const SceneArgument& scene_argument, const CheckedScene& scene,
                const UnitArgument& unit, const JointPathArgument& path,
                const BudgetArgument& budget, const ResultFiles& files) const;
};

}  // namespace beeline::command
