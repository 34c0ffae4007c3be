#pragma once

#include <array>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// Writers try these numbers of significant digits in turn and take the first that reads back
/// exactly: 1.5708 rather than 1.5708000000000002. 17 digits distinguish any two doubles.
constexpr std::array<int, 7> readable_digits{4, 6, 9, 12, 15, 16, 17};

/// Rounds every component to `digits` significant digits; -0 becomes 0.
Vector3 rounded(const Vector3& v, int digits);

}  // namespace beeline::internal
