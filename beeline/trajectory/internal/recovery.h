#pragma once

#include <algorithm>

#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {

/// Throws Error unless `recover` is from 0 to max_recover.
void check_recover(double recover);

/// Returns by how much q exceeds the limits, negative inside them.
inline double excess_over(const Limits& limits, double q) {
  return std::max(limits.lower - q, q - limits.upper);
}

/// Returns the largest excess of q over a position limit, rad or m; negative inside the limits.
double largest_excess(const Arm& arm, const ConfigurationRef& q);

/// Whether a motion must recover from this excess, and may, to rounding.
constexpr bool may_recover(double excess, double recover) {
  return excess > position_slack && excess <= recover + position_slack;
}

/// Returns whether a motion that starts at q must recover: whether q exceeds the position limits by
/// more than position_slack. Throws Error, of the option, if it exceeds them by more than
/// `recover`.
bool starts_outside(const Arm& arm, const ConfigurationRef& q, double recover,
                    const char* option = "start");

}  // namespace beeline::internal
