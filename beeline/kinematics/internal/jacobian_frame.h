#pragma once

#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// Replaces the columns of the base frame by those of another frame.
void set_frame(Frame frame, const Pose& world_T_tool, Eigen::Ref<Jacobian> columns);

}  // namespace beeline::internal
