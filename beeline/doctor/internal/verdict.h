#pragma once

#include <vector>

#include <beeline/doctor/comparison.h>

namespace beeline::internal {

/// Compares the properties that do not change the tool's pose at a configuration: limits (with the
/// offsets and signs of the comparison taken into account), the order of the joints' names, and
/// mimic joints. Returns nothing if the numbers of joints differ.
std::vector<ModelDifference> other_differences(const Arm& a, const Arm& b,
                                               const ArmComparison& comparison, double tolerance);

/// Sets status and verdict of a comparison from its differences.
void judge(const Arm& a, const Arm& b, ArmComparison& comparison);

}  // namespace beeline::internal
