#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/stated_units.h>
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

/// The columns of a trajectory's joints, and the units that names and comments give for them.
struct RecordedColumns {
  ColumnsInUnits joints = {};
  /// The columns of velocities and of accelerations, one for each joint, where they are apart from
  /// `joints` by NAME_vel and NAME_acc; otherwise empty.
  std::array<ColumnsInUnits, 2> rates = {};
  StatedUnits stated = {};  ///< by comments
};

struct TableRecording {
  Recording recording;  ///< as written: rates may be in another unit than their joint
  RecordedColumns columns;
};

/// Throws FileError for comments that give joints other units than rad and m, or that are not
/// clear: without an arm it is not known which joints turn.
void check_without_arm(const StatedUnits& stated, const std::string& path);

/// Parses columns of times (time_columns()), then the joints' names, and NAME_vel, NAME_acc where
/// known, in any order. A column is a velocity if its name without `_vel` is also a column. Columns
/// of names and frames, texts, are skipped. With an arm, names have units as columns_in_units()
/// says, NAME_velocity, velocity_NAME and the like are rates of a column NAME if all columns have
/// them, efforts are skipped, and so is a first column without a name. The unit of times is given
/// by the options, else by the column's name or a comment, else by unit_of_times(); without an arm
/// a column `t` is in seconds. Times since 1970 count from the first if they have a smaller unit
/// than seconds or nanoseconds in another column. Times must increase. Names of columns and endings
/// are in upper or lower case. Without a header a row has t and the joints' positions or, three
/// times as long, their velocities and accelerations too. Holds the numbers and one row in memory.
/// Throws FileError that names the line and the column.
TableRecording recording_from_csv(std::string_view text, const std::string& path,
                                  const TableOptions& options = {});
TableRecording recording_from_csv(InputFile& file, const TableOptions& options = {});
/// Returns its trajectory.
Trajectory trajectory_from_csv(std::string_view text, const std::string& path);

/// Throws Error for a joint with the name `t` or with the name of another joint's velocity or
/// acceleration.
std::string trajectory_to_csv(const Trajectory& trajectory);

}  // namespace beeline::internal
