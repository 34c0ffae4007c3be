#pragma once

#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// Transforms the columns of a Jacobian from the base frame to another frame.
void set_frame(Frame frame, const Pose& world_T_tool, Eigen::Ref<Jacobian> columns);

}  // namespace beeline::internal
