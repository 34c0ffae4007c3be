#pragma once

#include <Eigen/Core>

#include <beeline/model/arm.h>

namespace beeline::web {

/// The arm of a handle. Throws Error for an unknown one.
const Arm& arm_of(int handle);

/// The joint values in a buffer of the page, as long as the arm has coordinates.
inline Eigen::Map<const Configuration> joint_values(const double* q, int dof) {
  return Eigen::Map<const Configuration>(q, dof);
}

}  // namespace beeline::web
