#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Whether adding 2 pi to coordinate k leaves the posture unchanged: its joint is revolute, and so
/// are all joints that mimic it, with integer ratios.
bool is_periodic(const Arm& arm, int k);

}  // namespace beeline::internal
