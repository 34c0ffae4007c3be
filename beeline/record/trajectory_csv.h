#pragma once

#include <string>
#include <string_view>

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Columns t, then the joints' names, and NAME_vel, NAME_acc where known. Read in any order: a
/// column is a velocity when its name less `_vel` is a column too. Times must increase.
/// Throws FileError naming line and column.
Trajectory trajectory_from_csv(std::string_view text, const std::string& path);

/// Throws Error for a joint called `t`, or like another joint's velocity or acceleration.
std::string trajectory_to_csv(const Trajectory& trajectory);

}  // namespace beeline
