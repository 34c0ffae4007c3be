#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/planning/program.h>

#include "pose_argument.h"

/// The arm as seen from the frame of --work: reasons and nearby paths of motions planned with it
/// are in that frame. Where the task's rows depend on the axes of the world, the arm as it is.
struct WorkFrame {
  beeline::Arm arm;
  beeline::Pose frame_T_world = beeline::Pose::Identity();
  std::string note = {};  ///< "; positions are in the frame of --work", the end of a reason

  WorkFrame(const beeline::Arm& world_arm, const beeline::Task& task, const WorkArgument& work,
            const UnitArgument& unit);

  std::vector<beeline::Pose> seen(std::vector<beeline::Pose> world_poses) const;
  beeline::Program seen(beeline::Program world_program) const;
};
