#pragma once

#include <beeline/model/arm.h>

namespace beeline {

/// The tool's pose, four columns of four numbers, at q, which has the arm's dof numbers. Where a
/// number of q is not finite those of the pose are not.
void forward_kernel(const Arm& arm, const double* q, double* world_T_tool);

/// The same, and the Jacobian in the base frame: dof columns of six. Requires that every joint has
/// a coordinate of its own (ChainAngles::in_order).
void jacobian_kernel(const Arm& arm, const double* q, double* world_T_tool, double* columns);

}  // namespace beeline
