#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/planning/program.h>

#include "pose_argument.h"

namespace beeline::command {

/// The frame of positions in reasons.
enum class PositionFrame {
  only,   ///< the world, as there is no other frame
  work,   ///< the frame of --work
  world,  ///< the world, in spite of --work
};

/// The arm as seen from the frame of --work: reasons and nearby paths of motions planned with it
/// are in that frame. Where the task's rows depend on the axes of the world, the arm as it is.
struct WorkFrame {
  Arm arm;
  Pose frame_T_world = Pose::Identity();
  PositionFrame positions = PositionFrame::only;

  WorkFrame(const Arm& world_arm, const Task& task, const WorkArgument& work,
            const UnitArgument& unit);

  std::vector<Pose> seen(std::vector<Pose> world_poses) const;
  Program seen(Program world_program) const;
};

}  // namespace beeline::command
