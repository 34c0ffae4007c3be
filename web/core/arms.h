#pragma once

#include <Eigen/Core>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/model/arm.h>

namespace beeline::web {

/// The arm of a handle. Throws Error for an unknown one.
const Arm& arm_of(int handle);

/// The arm's solver with these options, which is kept until the arm is released.
InverseSolver& solver_of(int handle, bool all, bool ignore_limits);

/// The joint values in a buffer of the page, as long as the arm has coordinates.
inline Eigen::Map<const Configuration> joint_values(const double* q, int dof) {
  return Eigen::Map<const Configuration>(q, dof);
}

}  // namespace beeline::web
