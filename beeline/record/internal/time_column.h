#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <beeline/record/trajectory_file.h>

namespace beeline::internal {

/// The columns of a table that hold the times of its rows.
struct TimeColumns {
  std::size_t index = 0;                        ///< of the times, or of their whole seconds
  std::optional<std::size_t> nanoseconds = {};  ///< of the remainder
  std::optional<TimeUnit> unit = std::nullopt;  ///< as the column's name says
  std::vector<std::size_t> others = {};         ///< further columns of times
};

/// Returns the columns of times by their names:
///   - `t`; then all other columns are joints
///   - t, time, timestamp, time_stamp or stamp, in any case, as the last part of a name with / or .
///     between its parts, without % or _ in front; a unit may follow, as in time_ns, t[ms] and
///     Time (s). T alone may be a joint.
///   - sec or secs, alone or with nanosec, nsec or nsecs of the same message
std::optional<TimeColumns> time_columns(const std::vector<std::string>& names);

/// Whether a comment with these items may be a header: it has a column of times.
bool names_times(const std::vector<std::string>& names);

/// Returns the unit of times without a named one, from the first of them: seconds unless they are
/// times since 1970 in a smaller unit, which exceed 1e11.
TimeUnit unit_of_times(double first);

/// The seconds of a unit.
double seconds_per(TimeUnit unit);

}  // namespace beeline::internal
