#pragma once

#include <optional>
#include <string_view>

#include <beeline/io/text/internal/column_unit.h>

namespace beeline::internal {

/// A unit of positions, rates or times in which no numbers are read.
struct ForeignUnit {
  std::optional<Quantity> quantity;  ///< none: counts and the like, of angles or lengths
  int power = 0;                     ///< of 1 / s
  /// Whether the word states a unit as a part of a column's name: `counts_joint1`.
  bool counts_in_names = false;
  /// Whether the word is nothing but a unit, and so states one anywhere in a text.
  bool is_only_a_unit = false;
};

/// Returns the one of a word in lower case; null for any other word.
const ForeignUnit* foreign_unit(std::string_view word);

/// Whether the word, in lower case, is a unit of a quantity that is not read, such as Nm, A or Hz,
/// or stands for no unit, as `-` and `1`.
bool is_unit_of_other_quantity(std::string_view word);

}  // namespace beeline::internal
