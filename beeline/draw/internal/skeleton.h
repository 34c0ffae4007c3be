#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Joint i of an arm in the world: the arm's centre line meets its axis at `enter` and leaves it at
/// `leave`.
struct SkeletonJoint {
  JointKind kind = JointKind::revolute;
  Vector3 direction = Vector3::UnitZ();  ///< of the axis, of unit length
  Vector3 enter = Vector3::Zero();
  Vector3 leave = Vector3::Zero();
  Vector3 centre = Vector3::Zero();  ///< position of the symbol: midpoint of the two, `enter` for a
                                     ///< prismatic joint
};

/// The centre line of an arm from base to tool, metres, in the world. It follows the joint axes and
/// their common perpendiculars (the lengths d and a of Denavit & Hartenberg), so it does not depend
/// on the choice of link frames.
struct Skeleton {
  Vector3 base = Vector3::Zero();
  std::vector<SkeletonJoint> joints;
  Vector3 tool = Vector3::Zero();

  std::vector<Vector3> line() const;  ///< base, then enter and leave of every joint, then tool
  double size() const;                ///< the greatest distance of its points from the base, metres
};

/// Computes the skeleton at configuration q. Throws Error when q does not fit the arm.
Skeleton skeleton(const Arm& arm, const ConfigurationRef& q);

}  // namespace beeline::internal
