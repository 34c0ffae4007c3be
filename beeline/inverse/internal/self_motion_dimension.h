#pragma once

#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns the dimension of the set of solutions that contains one of `solutions` for the pose,
/// limits ignored: n - r for n coordinates and the rank r of the task's Jacobian J, if r is the
/// largest rank that J has anywhere. Then the rank is constant around that solution, and the
/// constant rank theorem makes the set a manifold. The largest rank is found at several random
/// configurations.
///
/// If every solution is singular, or r = n, the rank proves nothing about the singular solutions.
/// Their dimension is found numerically: configurations beside a solution are brought back to the
/// pose, and the dimension is the number of independent directions in which they then are; the
/// median of several solutions.
int self_motion_dimension(const Arm& arm, const Task& task, const Pose& world_T_tool,
                          const std::vector<Configuration>& solutions);

}  // namespace beeline::internal
