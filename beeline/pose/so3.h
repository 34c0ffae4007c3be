#pragma once

#include <Eigen/Core>

namespace beeline {

/// An orthonormal, right-handed matrix. A rotation vector is unit axis times angle, rad.
using Rotation = Eigen::Matrix3d;
using Vector3 = Eigen::Vector3d;

/// The skew-symmetric matrix of the cross product: hat(a) * b == a x b.
Eigen::Matrix3d hat(const Vector3& a);

/// The exponential, by Rodrigues' formula (Lynch & Park, "Modern Robotics", 2017, eq. 3.51).
/// Accurate to rounding for every length of `rotation_vector`, zero included.
Rotation so3_exp(const Vector3& rotation_vector);

/// The logarithm: the shortest rotation vector whose exponential is `rotation`, of length in
/// [0, pi]. Accurate near 0 and near pi; at pi one of the two opposite vectors. Does not check that
/// the matrix is a rotation.
///
/// The kernels have two more versions of the same definition. rotation_log() in
/// kinematics/task-inl.h processes eight rotations in the lanes of registers, where a branch costs
/// all eight. inverse/numerical/gauss_newton.cpp uses the series near zero on plain numbers,
/// because the quaternion would take a third of an iteration.
Vector3 so3_log(const Rotation& rotation);

/// The left Jacobian of SO(3): the angular velocity of so3_exp(r), in the axes of r, is w = J(r)
/// r', with
///     J(r) = I + (1 - cos a)/a^2 [r] + (a - sin a)/a^3 [r]^2,   a = |r|
/// (Chirikjian, "Stochastic Models, Information Theory, and Lie Groups", vol. 2, 2011, eq. 10.86).
/// The right Jacobian, of the angular velocity in the rotated axes, is J(-r), the transpose.
Eigen::Matrix3d so3_left_jacobian(const Vector3& r);

/// J(r)^-1 = I - [r]/2 + (1 - (a/2) cot(a/2))/a^2 [r]^2 for |r| < 2 pi: the derivative of the
/// logarithm.
Eigen::Matrix3d so3_left_jacobian_inverse(const Vector3& r);

/// Returns the equivalent angle in [-pi, pi], rad.
double wrap_angle(double radians);

/// a ⊖ b (Dellaert, *Serial Link Manipulators*, section 1.8): the rotation by the smallest angle
/// that takes b to a, in [-pi, pi], rad.
double angle_difference(double a, double b);

/// Returns `radians` plus the multiple of 2 pi that brings it nearest to `reference`.
double nearest_angle(double radians, double reference);

}  // namespace beeline
