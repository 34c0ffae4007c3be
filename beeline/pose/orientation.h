#pragma once

#include <iosfwd>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// Roll, pitch and yaw as in URDF: rotations about the fixed axes X, then Y, then Z. Radians.
struct RollPitchYaw {
  double roll = 0;
  double pitch = 0;
  double yaw = 0;
};

/// Rz(yaw) Ry(pitch) Rx(roll).
Rotation rotation(const RollPitchYaw& rpy);

/// The inverse of rotation(), with pitch in [-pi/2, pi/2]. In gimbal lock, at pitch +-pi/2, roll is
/// 0 and yaw is the whole rotation about the vertical.
RollPitchYaw roll_pitch_yaw(const Rotation& rotation);

/// Returns the rotation of the quaternion qw + qx i + qy j + qz k, normalised.
/// Throws Error when its length differs from 1 by more than 1e-3, which is likely a mistyped value.
Rotation rotation_from_quaternion(double qw, double qx, double qy, double qz);

/// A unit quaternion with qw >= 0.
struct Quaternion {
  double qw = 1, qx = 0, qy = 0, qz = 0;
};
Quaternion quaternion(const Rotation& rotation);

/// Returns the pose with this position (metres) and orientation.
Pose make_pose(const Vector3& position, const Rotation& rotation = Rotation::Identity());

/// Prints position, roll, pitch and yaw: `x 0.3, y 0, z 0.5 m, roll 0, pitch 1.5708, yaw 0 rad`.
/// Pose is an alias of a type of Eigen's, so code outside this namespace needs
/// `using beeline::operator<<;` for `out << pose`.
std::ostream& operator<<(std::ostream& out, const Pose& pose);

}  // namespace beeline
