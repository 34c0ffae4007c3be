#pragma once

#include <numbers>

namespace beeline::internal {

/// One revolution of a joint, radians.
inline constexpr double revolution = 2 * std::numbers::pi;

}  // namespace beeline::internal
