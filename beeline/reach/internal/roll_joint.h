#pragma once

#include <optional>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// A last joint that rotates the tool about the tool's z axis and moves nothing else.
struct RollJoint {
  double sign = 1;  ///< the rotation of the tool about its z axis for a positive one of the joint

  /// Returns the value of the joint that is equivalent modulo 2 pi to `q` turned by `roll` (rad)
  /// and nearest to the middle of its limits; none if that is outside them.
  std::optional<double> turned(const Arm& arm, double q, double roll) const;
};

/// Returns the arm's; none where the last joint is another one, or has a mimic joint.
std::optional<RollJoint> roll_joint(const Arm& arm);

/// Returns the arm whose last joint has no position limits.
Arm with_free_roll(const Arm& arm);

}  // namespace beeline::internal
