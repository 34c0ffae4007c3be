#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <beeline/doctor/comparison.h>

namespace beeline::internal {

/// Joints of two arms that are the same joint: index in A, index in B.
using JointPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Compares the properties that do not change the tool's pose at a configuration: limits (with the
/// offsets and signs of the comparison taken into account), the order of the joints' names, and
/// mimic joints.
std::vector<ModelDifference> other_differences(const Arm& a, const Arm& b, const JointPairs& pairs,
                                               const ArmComparison& comparison, double tolerance);

/// Sets status and verdict of a comparison from its differences.
void judge(const Arm& a, const Arm& b, ArmComparison& comparison);

}  // namespace beeline::internal
