#pragma once

#include <numbers>

namespace beeline::testing {

inline constexpr double deg = std::numbers::pi / 180;  ///< radians

}  // namespace beeline::testing
