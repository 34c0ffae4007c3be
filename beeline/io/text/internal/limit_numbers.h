#pragma once

#include <cmath>
#include <string_view>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/numbers.h>
#include <beeline/model/internal/ranges.h>

namespace beeline::internal {

// URDF and YAML files say "no limit" by an infinity, by the largest float or double, by 1e16 (the
// default of SDFormat) or by another number beyond any joint. Every number beyond the range of
// limits that an Arm accepts stands for none.

/// Parses a limit as parse_limit(). With a fault `value` is not defined.
ElementFault read_limit(std::string_view text, double& value);

/// Parses a number as parse_number(), or an infinity: `inf`, `-Infinity`, `.inf` as in YAML,
/// `1e999`. Throws Error, which begins with `what`, for anything else.
double parse_limit(std::string_view text, std::string_view what);

inline bool no_lower_limit(double value) { return value < -Limits::max_position; }
inline bool no_upper_limit(double value) { return value > Limits::max_position; }
inline bool no_rate_limit(double value) { return std::abs(value) > Limits::max_rate; }

}  // namespace beeline::internal
