#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Computes world_T_tool, a column-major 4 x 4 matrix, at the arm.dof() values of q. It is not
/// finite where a value of q is not.
void forward_kernel(const Arm& arm, const double* q, double* world_T_tool);

/// Computes the same and the Jacobian in Frame::base, dof columns of six. Requires that every joint
/// has its own coordinate (ChainAngles::in_order).
void jacobian_kernel(const Arm& arm, const double* q, double* world_T_tool, double* columns);

}  // namespace beeline::internal
