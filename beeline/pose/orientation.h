#pragma once

#include <beeline/pose/se3.h>

namespace beeline {

/// Roll, pitch, yaw as in URDF: turns about the fixed axes X, then Y, then Z. Radians.
struct RollPitchYaw {
  double roll = 0;
  double pitch = 0;
  double yaw = 0;
};

Rotation rotation(const RollPitchYaw& rpy);

/// pitch in [-pi/2, pi/2]; where it is +-pi/2 (gimbal lock) roll is 0 and yaw takes the rest.
RollPitchYaw roll_pitch_yaw(const Rotation& rotation);

/// The rotation of the quaternion w + xi + yj + zk, which is normalised first.
/// Throws Error when its length is not within 1e-3 of one: a typing slip, most likely.
Rotation rotation_from_quaternion(double qw, double qx, double qy, double qz);

/// The unit quaternion with w >= 0. Named fields, never four bare numbers.
struct Quaternion {
  double qw = 1, qx = 0, qy = 0, qz = 0;
};
Quaternion quaternion(const Rotation& rotation);

/// A pose from its position and orientation.
Pose make_pose(const Vector3& position, const Rotation& rotation = Rotation::Identity());

}  // namespace beeline
