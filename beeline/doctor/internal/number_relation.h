#pragma once

#include <string>

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Returns how a wrong number may come from the right one, as a clause: `the other sign`,
/// `millimetres`, `pi/2 with 5 digits`. Empty if no usual mistake relates the two.
std::string length_relation(double in_a, double in_b);
std::string angle_relation(double in_a, double in_b);

/// Returns the relation of two rotations: roll, pitch and yaw about other axes, degrees read as
/// radians, the inverse, a quaternion in another order.
std::string rotation_relation(const Rotation& in_a, const Rotation& in_b);

/// Returns `pi/2 with 4 digits` if the angle is a multiple of pi/2 that was written with 3 to 10
/// significant digits, rounded or cut off; otherwise empty. The multiple is `nearest`.
std::string truncated_right_angle(double angle, double* nearest = nullptr);

/// A rotation that results by mistake from the numbers of a rotation (roll, pitch and yaw about the
/// fixed axes X, Y, Z), with a clause that names the mistake.
struct MistakenRotation {
  std::string mistake;
  Rotation rotation;
};
constexpr int mistaken_rotations = 8;
/// Mistake number `k`, from 0 to mistaken_rotations - 1. The numbers are not unique: `second` takes
/// the other roll, pitch and yaw of the rotation.
MistakenRotation mistaken_rotation(const Rotation& right, int k, bool second);

}  // namespace beeline::internal
