#pragma once

#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns the dimension of the set of solutions that contains one of `solutions`, limits ignored:
/// n - r for n coordinates and the rank r of the task's Jacobian J, if r is the largest rank that J
/// has anywhere. Then the rank is constant around that solution, and the constant rank theorem
/// makes the set a manifold. Returns 0 if every solution is singular, because the rank then proves
/// nothing. The largest rank is found at several random configurations.
int self_motion_dimension(const Arm& arm, const Task& task,
                          const std::vector<Configuration>& solutions);

}  // namespace beeline::internal
