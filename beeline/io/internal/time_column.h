#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// The columns of a table that hold the times of its rows.
struct TimeColumns {
  std::size_t index = 0;                  ///< of the times, or of their whole units
  const Unit* unit = nullptr;             ///< as the column's name says
  std::optional<std::size_t> finer = {};  ///< of the remainder, or of the times again
  const Unit* finer_unit = nullptr;       ///< of that column
  std::vector<std::size_t> others = {};   ///< further columns of times
};

/// Returns the columns of times by their names:
///   - `t`; then all other columns are joints, except one of its remainder
///   - t, time, timestamp, time_stamp, stamp, date, datetime, date_time, time_from_start,
///     elapsed_time, elapsed or uptime, in any case, as the last part of a name with / or . between
///     its parts, without % or _ in front; a unit may follow, as in time_ns, t[ms], t/ms and Time
///     (s). T, which may be a joint, only if there is no other.
///   - sec or secs, alone or with a finer unit such as nanosec or usec of the same message; also
///     with the name of a time or `tv` in front, as in stamp_sec and stamp_nanosec
/// A column of the same time in a finer unit, as time_ns or nanosec beside time_s, is `finer`.
/// Throws Error for two of them.
std::optional<TimeColumns> time_columns(const std::vector<std::string>& names);

/// Whether a comment with these items may be a header: it has a column of times.
bool names_times(const std::vector<std::string>& names);

/// The unit as one of a file.
const Unit& unit_of(TimeUnit unit);
TimeUnit time_unit_of(const Unit& unit);

/// The end of an error for a time unit that a file cannot have.
inline constexpr const char* time_unit_refusal =
    "a time unit (time_unit, --time-unit) is for tables with one column of times";

/// Whether this may be a time since 1970, of the year 1973 or later.
bool is_since_1970(double seconds);

/// Returns the unit of times without a named one, from the first of them: seconds up to the year
/// 2100, counted from 1970, otherwise the smaller unit in which it is a time since 1970 of the
/// years 1990 to 2100. Null if there is none.
const Unit* unit_of_times(double first);

}  // namespace beeline::internal
