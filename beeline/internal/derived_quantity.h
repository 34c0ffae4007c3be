#pragma once

#include <optional>
#include <string_view>

namespace beeline::internal {

/// A quantity of a joint that is not its position.
enum class DerivedQuantity {
  velocity,
  acceleration,
  effort,
  other,     ///< jerk, temperature, ...; also `qd`, which may be a velocity or the desired position
  property,  ///< an error, a limit, a state or a statistic of a position or of another quantity
};

/// Returns the one that a word, in any case, names: velocity, vel, speed, torque, error, max; none
/// for another word.
std::optional<DerivedQuantity> derived_quantity(std::string_view word);

/// Whether one of the words of a text, in any case, names one that is no property: `velocity_`,
/// `/measured/torque.`.
bool says_derived_quantity(std::string_view text);

}  // namespace beeline::internal
