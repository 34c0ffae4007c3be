#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace beeline::internal {

/// Endings of the columns of rates in files of this library.
inline constexpr std::string_view velocity_suffix = "_vel";
inline constexpr std::string_view acceleration_suffix = "_acc";

/// The index of each column by its name.
using ColumnIndex = std::unordered_map<std::string, std::size_t>;

/// Returns the joint whose velocity or acceleration the column would be, by its suffix in any case;
/// empty for a name without suffix.
std::string joint_of_rate(const std::string& column);

/// Returns the header with the suffixes of velocities and accelerations in lower case.
std::vector<std::string> with_known_suffixes(std::vector<std::string> header);

/// Renames the columns of rates of other programs, such as NAME_velocity, accel.NAME and
/// NAME_speed, to NAME_vel and NAME_acc, if there is a column NAME and all such columns have the
/// rate. Removes columns of efforts and torques from `columns`. A column with a name of `joints` is
/// none of these.
void rename_rates(std::vector<std::string>& header, ColumnIndex& columns,
                  const std::vector<std::string>& joints);

/// Returns the columns of the joints' names with this suffix: one for every joint, or none. Throws
/// Error for a column that is missing.
std::vector<std::size_t> rate_columns(const std::vector<std::string>& joints,
                                      const ColumnIndex& columns, std::string_view suffix);

}  // namespace beeline::internal
