#pragma once

#include <beeline/doctor/comparison.h>

namespace beeline::internal {

/// Sets status and verdict of a comparison from its differences.
void judge(const Arm& a, const Arm& b, ArmComparison& comparison);

}  // namespace beeline::internal
