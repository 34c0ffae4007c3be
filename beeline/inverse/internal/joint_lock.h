#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The arm with coordinate k standing still at a value: its joint, and those that follow it, are
/// parts of the links then, and it has one coordinate less. Throws Error when it has one only.
Arm with_locked(const Arm& arm, int k, double value);

/// q without coordinate k, and with it again.
Configuration without(const Configuration& q, int k);
Configuration with(const Configuration& q, int k, double value);

}  // namespace beeline::internal
