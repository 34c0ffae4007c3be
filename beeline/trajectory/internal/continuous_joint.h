#pragma once

#include <numbers>

#include <beeline/model/arm.h>

namespace beeline::internal {

constexpr double revolution = 2 * std::numbers::pi;

/// Whether coordinate k is_periodic() and has no position limits: nothing stops its revolutions.
bool is_continuous(const Arm& arm, int k);

}  // namespace beeline::internal
