#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace beeline::internal {

/// A column of a table whose numbers are counted from the first row.
struct CountedColumn {
  std::size_t column = 0;
  std::string item = {};                      ///< of the row
  double value = 0;                           ///< of the row
  std::optional<double> first = {};           ///< of the first row
  std::optional<std::int64_t> first_whole{};  ///< the same, if it is a whole number
  double from_first = 0;

  /// Sets `from_first` by the row's value: exactly if its item is a whole number below 2^63.
  void count();
  /// The same by a whole number, of which so many are one; none: by the value.
  void count(std::optional<std::int64_t> whole, double per_one);
};

}  // namespace beeline::internal
