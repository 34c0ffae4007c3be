#pragma once

#include <optional>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// A revolute joint at an end of the arm that turns all of the arm about the world's z axis, or
/// only the tool about its own: its value changes by the angle, and no other joint's value changes.
struct TurningJoint {
  int coordinate = 0;
  double sign = 1;  ///< the rotation about that z axis for a positive one of the joint
  Vector3 axis_point = Vector3::Zero();  ///< of a base joint: on its axis, in the world, z = 0

  /// Returns the value that is equivalent modulo 2 pi to `q` turned by `angle` (rad) and nearest to
  /// the middle of the joint's limits; none if that is outside them.
  std::optional<double> turned(const Limits& limits, double q, double angle) const;
};

/// Whether a coordinate belongs to a revolute joint that no other joint follows.
bool turns_alone(const Arm& arm, int coordinate);

/// The angle between the first joint's axis and the world's z or -z, rad.
double base_tilt(const Arm& arm);

/// Returns the first joint of an arm if its axis is parallel to the world's z axis and no mimic
/// joint follows it; otherwise none.
std::optional<TurningJoint> base_joint(const Arm& arm);

/// Returns the last joint of an arm if it rotates the tool about the tool's z axis, moves nothing
/// else, and no mimic joint follows it; otherwise none.
std::optional<TurningJoint> roll_joint(const Arm& arm);

/// Returns the arm with that joint without position limits.
Arm without_limits(const Arm& arm, const TurningJoint& joint);

}  // namespace beeline::internal
