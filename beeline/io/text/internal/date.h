#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace beeline::internal {

/// An instant, as a date with a time of day gives it.
struct Date {
  std::int64_t nanoseconds = 0;  ///< since 1970; without a zone, as if the zone was UTC
  bool has_zone = false;
};

/// The end of an error for a text that is no such date.
inline constexpr const char* not_a_date =
    " is not a date with a time, such as 2024-05-01T12:00:00.123Z";

/// Parses a date of ISO 8601, `2024-05-01T12:00:00.123Z`: a blank may stand for the T, the seconds
/// or their fraction of at most nine digits may be missing, and the zone is Z, an offset such as
/// +02:00, +0200 or +02, or missing. Returns none for a text that does not begin as a date. Throws
/// Error for any other text, and for years outside 1678 to 2261, whose nanoseconds 64 bits hold.
std::optional<Date> parse_date(std::string_view text);

}  // namespace beeline::internal
