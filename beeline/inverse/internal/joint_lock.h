#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the arm with coordinate k fixed at a value. Its joint, and the joints that mimic it,
/// become parts of the links, and the arm has one coordinate less. Throws Error when it has only
/// one.
Arm with_locked(const Arm& arm, int k, double value);

/// Returns q without coordinate k, and q with coordinate k inserted at `value`.
Configuration without(const Configuration& q, int k);
Configuration with(const Configuration& q, int k, double value);

}  // namespace beeline::internal
