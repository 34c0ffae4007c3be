#include <charconv>
#include <limits>

#include <beeline/io/text/internal/counted_column.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// The whole number that the text is; none for another text.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void CountedColumn::count() { count(whole_number(trimmed(item)), 1); }

void CountedColumn::count(std::optional<std::int64_t> whole, double per_one) {
  using Whole = std::numeric_limits<std::int64_t>;
  if (!first) {
    first = value;
    first_whole = whole;
  }
  from_first = value - *first;
  if (!whole || !first_whole) return;
  const bool overflows = *first_whole < 0 ? *whole > Whole::max() + *first_whole
                                          : *whole < Whole::min() + *first_whole;
  if (!overflows) from_first = static_cast<double>(*whole - *first_whole) / per_one;
}

}  // namespace beeline::internal
