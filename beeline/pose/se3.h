#pragma once

#include <Eigen/Geometry>
#include <iosfwd>
#include <string>

#include <beeline/error.h>
#include <beeline/pose/so3.h>

namespace beeline {

/// Position (metres) and orientation of one frame in another, named `outer_T_inner`.
using Pose = Eigen::Isometry3d;

/// A twist, linear part first: [vx vy vz wx wy wz], in metres and radians or, as a velocity, per
/// second.
using Twist = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A pose that depends on a parameter (time, or a path parameter), with its derivatives: the
/// velocity [v w] of its origin and its angular velocity, and the derivatives of both, in world
/// axes; metres and radians.
struct PoseMotion {
  Pose pose = Pose::Identity();  ///< pose at the parameter
  /// First derivative: the velocity of the origin and the angular velocity.
  Twist velocity = Twist::Zero();
  Twist acceleration = Twist::Zero();  ///< second derivative
};

/// Returns the reason why `pose` is not a rigid motion, as a clause; empty if it is one. It needs
/// finite numbers, coordinates of at most 1e100 m (beyond, squares overflow), the last row 0 0 0 1,
/// and a right-handed rotation that is orthonormal to 1e-6, as numbers of seven digits are.
std::string rigid_motion_fault(const Pose& pose);

/// Returns `pose` with its rotation orthonormal to rounding. If the rotation deviates by more than
/// 1e-14, the rotation of the nearest unit quaternion replaces it. Throws Error for a
/// rigid_motion_fault(); the message calls the pose `what`.
Pose checked_pose(const Pose& pose, const char* what = "the pose");
Pose checked_pose(const Pose& pose, const std::string& what);

/// The exponential of SE(3): the motion by constant `twist` for unit time (Lynch & Park, "Modern
/// Robotics", 2017, eq. 3.88, there with the angular part first).
Pose se3_exp(const Twist& twist);

/// The logarithm of SE(3), whose rotation is by at most pi: se3_exp(se3_log(T)) == T.
Twist se3_log(const Pose& pose);

/// The adjoint Ad(a_T_b): maps a twist in frame b to the same twist in frame a.
Matrix6 adjoint(const Pose& pose);
Twist adjoint(const Pose& pose, const Twist& twist);

/// The straight line from `from` (s = 0) to `to` (s = 1): the position moves at constant velocity,
/// the orientation about a fixed axis at constant angular velocity, by at most pi.
Pose interpolate(const Pose& from, const Pose& to, double s);

/// The difference of two poses of one frame, in that frame's axes: [p_to - p_from;
/// log(R_to R_from^T)].
Twist pose_difference(const Pose& to, const Pose& from);

/// Roll, pitch and yaw as in URDF: rotations about the fixed axes X, then Y, then Z.
struct RollPitchYaw {
  double roll = 0;   ///< about X, rad
  double pitch = 0;  ///< about Y, rad
  double yaw = 0;    ///< about Z, rad
};

/// Rz(yaw) Ry(pitch) Rx(roll).
Rotation rotation(const RollPitchYaw& rpy);

/// The inverse of rotation(), with pitch in [-pi/2, pi/2]. In gimbal lock, at pitch +-pi/2, roll is
/// 0 and yaw is the whole rotation about the vertical.
RollPitchYaw roll_pitch_yaw(const Rotation& rotation);

/// Returns the rotation of the quaternion qw + qx i + qy j + qz k, normalised.
/// Throws Error when its length differs from 1 by more than 1e-3, which is likely a mistyped value.
Rotation rotation_from_quaternion(double qw, double qx, double qy, double qz);

/// A unit quaternion qw + qx i + qy j + qz k with qw >= 0.
struct Quaternion {
  double qw = 1;  ///< real part
  double qx = 0;  ///< factor of i
  double qy = 0;  ///< factor of j
  double qz = 0;  ///< factor of k
};
Quaternion quaternion(const Rotation& rotation);

/// Returns the pose with this position (metres) and orientation.
Pose make_pose(const Vector3& position, const Rotation& rotation = Rotation::Identity());

/// Prints position, roll, pitch and yaw: `x 0.3, y 0, z 0.5 m, roll 0, pitch 1.5708, yaw 0 rad`.
/// Pose is an alias of a type of Eigen's, so code outside this namespace needs
/// `using beeline::operator<<;` for `out << pose`.
std::ostream& operator<<(std::ostream& out, const Pose& pose);

namespace internal {

/// The alignment of Eigen's matrices, in bytes. -mavx and -march=native change it.
template <int in_objects, int on_heap>
struct EigenAlignment {};
using CompiledAlignment = EigenAlignment<EIGEN_MAX_STATIC_ALIGN_BYTES, EIGEN_DEFAULT_ALIGN_BYTES>;

/// Defined for the library's alignment alone, so that a program of another alignment does not link:
/// a matrix that crosses from one to the other might crash it.
void aligns_eigen_as_the_library(CompiledAlignment);
[[gnu::used]] inline void (*const compiled_alignment)(CompiledAlignment) =
    &aligns_eigen_as_the_library;

}  // namespace internal
}  // namespace beeline
