#pragma once

#include <optional>
#include <string>

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Why a pose cannot be reached, as one sentence, and how much is missing at least: metres, or
/// radians where the orientation is the obstacle.
struct Infeasibility {
  double missing = 0;
  bool of_orientation = false;
  std::string reason;
};

/// The pose is outside the ball that the tool never leaves, within limits (Arm::reach).
std::optional<Infeasibility> beyond_reach(const Arm& arm, const Pose& world_T_tool,
                                          const Task& task, double tolerance);

/// The same, where that ball would not grow if the limits did not count: no search is needed then.
bool out_of_reach(const Arm& arm, const Pose& world_T_tool, const Task& task, double tolerance);

/// Something of the tool's pose that no joint can change is not as the task asks. Looks at arms
/// whose axes are all parallel (the heights along them and the tilt against them stay) and at arms
/// that only slide (the orientation stays, and the position is in the span of the slides).
std::optional<Infeasibility> invariant_violation(const Arm& arm, const Pose& world_T_tool,
                                                 const Task& task, double tolerance);

/// The coordinate of q that is farthest outside the bounds, as a clause: `joint2 would be at
/// 2.5 rad (...), 0.3 rad (...) above its upper limit 2.2 rad (...)`. Requires that one is outside.
std::string blocking_joint(const Arm& arm, const Configuration& q, const Bounds& bounds);

/// A point as a phrase: `(0.1, 0.2, 0.3)`.
std::string point(const Vector3& p);

/// How far q is outside the bounds in all: the sum over its coordinates.
double excess(const Bounds& bounds, const Configuration& q);

/// What is left of a task as a phrase, without the part that is within the tolerance: `0.2 m`,
/// `0.1 rad (5.73 deg)`, or both.
std::string miss(const Deviation& error, double tolerance);

}  // namespace beeline::internal
