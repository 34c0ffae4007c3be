#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// Joint i of an arm in the world: the arm's line enters its axis at `enter` and leaves at `leave`.
struct SkeletonJoint {
  JointKind kind = JointKind::revolute;
  Vector3 direction = Vector3::UnitZ();  ///< of the axis, of unit length
  Vector3 enter = Vector3::Zero();
  Vector3 leave = Vector3::Zero();
  Vector3 centre =
      Vector3::Zero();  ///< where the joint is seen: between the two, or a slide's start
};

/// The shape of an arm as a line from base to tool, metres, in the world. It follows the joint axes
/// and their common perpendiculars (the lengths d and a of Denavit & Hartenberg), so it does not
/// depend on where the link frames were put.
struct Skeleton {
  Vector3 base = Vector3::Zero();
  std::vector<SkeletonJoint> joints;
  Vector3 tool = Vector3::Zero();

  std::vector<Vector3> line() const;  ///< base, then enter and leave of every joint, then tool
  double size() const;                ///< the greatest distance of its points from the base
};

/// Throws Error when q does not fit the arm.
Skeleton skeleton(const Arm& arm, const ConfigurationRef& q);

}  // namespace beeline
