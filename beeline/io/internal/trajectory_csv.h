#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Properties of a table besides its text.
struct TableOptions {
  /// Names of the arm's joints, also for a table without a header. Empty: there is no arm; the
  /// table needs a header with the names of this library's files, without units and with rates
  /// NAME_vel and NAME_acc only.
  std::vector<std::string> joint_names = {};
  /// Whether the names in a comment are a header; null: all names with a column of times are.
  std::function<bool(const std::vector<std::string>&)> is_header = {};
  std::optional<TimeUnit> time_unit = std::nullopt;
  bool time_unit_is_optional = false;
  bool needs_times = true;  ///< otherwise rows without times are at 0, 1, 2, ... s
};

struct TableRecording {
  Recording recording;     ///< as written
  ColumnsInUnits columns;  ///< of the trajectory's joints
  StatedUnits stated;      ///< by comments
};

/// Parses columns of times (time_columns()), then the joints' names, and NAME_vel, NAME_acc where
/// known, in any order. A column is a velocity if its name without `_vel` is also a column. Columns
/// of names and frames, texts, are skipped. With an arm, names have units as columns_in_units()
/// says, rates that have another unit than their joint are converted to it, NAME_velocity,
/// velocity_NAME and the like are rates of a column NAME if all columns have them, and efforts are
/// skipped. The unit of times is given by the options, else by the column's name, else, unless the
/// column is `t`, by unit_of_times(). Times since 1970 count from the first if they have a smaller
/// unit than seconds or nanoseconds in another column. Times must increase. Names of columns and
/// endings are in upper or lower case. Without a header a row has t and the joints' positions or,
/// three times as long, their velocities and accelerations too. Holds the numbers and one row in
/// memory. Throws FileError that names the line and the column.
TableRecording recording_from_csv(std::string_view text, const std::string& path,
                                  const TableOptions& options = {});
TableRecording recording_from_csv(InputFile& file, const TableOptions& options = {});
/// Returns its trajectory.
Trajectory trajectory_from_csv(std::string_view text, const std::string& path);

/// Throws Error for a joint with the name `t` or with the name of another joint's velocity or
/// acceleration.
std::string trajectory_to_csv(const Trajectory& trajectory);

}  // namespace beeline::internal
