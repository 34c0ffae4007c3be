#pragma once

#include <Eigen/Core>

namespace beeline {

/// Rotations in space. A rotation vector is axis times angle, in radians.
using Rotation = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

/// The matrix of the cross product: hat(a) * b == a x b.
Eigen::Matrix3d hat(const Vector3& a);

/// Rodrigues' formula; accurate to rounding for every length of `rotation_vector`, zero included.
Rotation so3_exp(const Vector3& rotation_vector);

/// The shortest rotation vector whose exponential is `rotation`: length in [0, pi].
/// Accurate near 0 and near pi; at pi itself one of the two opposite vectors.
Vector3 so3_log(const Rotation& rotation);

}  // namespace beeline
