#pragma once

#include <string>

#include <beeline/inverse/numerical/bounds.h>

// Phrases of the reasons that inverse kinematics gives.

namespace beeline::internal {

/// A point: `(0.1, 0.2, 0.3)`.
std::string point(const Vector3& p);

/// The coordinate of q that is farthest outside the bounds, as a clause: `joint2 would be at
/// 2.5 rad (...), 0.3 rad (...) above its upper limit 2.2 rad (...)`. Requires that one is outside.
std::string blocking_joint(const Arm& arm, const Configuration& q, const Bounds& bounds);

/// The parts of an error that exceed the tolerance: `0.2 m`, `0.1 rad (5.73 deg)`, or both.
std::string miss(const Deviation& error, double tolerance);

}  // namespace beeline::internal
