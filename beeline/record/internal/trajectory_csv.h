#pragma once

#include <string>
#include <string_view>

#include <beeline/read/internal/file_stream.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Parses columns t, then the joints' names, and NAME_vel, NAME_acc where known, in any order. A
/// column is a velocity if its name without `_vel` is also a column. Times must increase.
/// The memory is that of the numbers and of one row. Throws FileError that names the line and the
/// column.
Trajectory trajectory_from_csv(std::string_view text, const std::string& path);
Trajectory trajectory_from_csv(InputFile& file);

/// Throws Error for a joint with the name `t` or with the name of another joint's velocity or
/// acceleration.
std::string trajectory_to_csv(const Trajectory& trajectory);

}  // namespace beeline::internal
