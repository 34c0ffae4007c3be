#pragma once

#include <numbers>

#include <beeline/model/arm.h>

namespace beeline::internal {

constexpr double revolution = 2 * std::numbers::pi;

/// Whether the arm's pose repeats when coordinate k has made a revolution, and no limit stops it:
/// the coordinate has no position limits, and the joints that it drives are revolute and make whole
/// revolutions.
bool is_continuous(const Arm& arm, int k);

}  // namespace beeline::internal
