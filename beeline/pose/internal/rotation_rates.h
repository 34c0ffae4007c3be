#pragma once

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// First and second time derivatives: r', r'' of a rotation vector r, or the angular velocity w and
/// acceleration w' of so3_exp(r) in the axes of r. They are related by the left Jacobian: w = J(r)
/// r', w' = J(r) r'' + J'(r) r'.
struct RotationRates {
  Vector3 velocity;
  Vector3 acceleration;
};

/// Returns w and w' for r' and r''.
RotationRates angular_motion(const Vector3& r, const RotationRates& derivatives);

/// Returns r' and r'' for w and w'; |r| < 2 pi.
RotationRates rotation_vector_rates(const Vector3& r, const RotationRates& motion);

}  // namespace beeline::internal
