#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/record/internal/recordable.h>
#include <beeline/record/internal/trajectory_csv.h>

namespace beeline::internal {
namespace {

constexpr std::string_view velocity_suffix = "_vel";
constexpr std::string_view acceleration_suffix = "_acc";

using Indices = std::vector<std::size_t>;
using Columns = std::unordered_map<std::string, std::size_t>;

/// Returns the joint whose velocity or acceleration the column would be; empty for a name without
/// suffix.
std::string joint_of_rate(const std::string& column) {
  for (const std::string_view suffix : {velocity_suffix, acceleration_suffix}) {
    if (column.ends_with(suffix)) return column.substr(0, column.size() - suffix.size());
  }
  return {};
}

/// Returns the columns of the joints' names with this suffix: one for every joint, or none.
Indices rate_columns(const std::vector<std::string>& joints, const Columns& columns,
                     std::string_view suffix) {
  Indices indices;
  std::string missing;
  for (const std::string& joint : joints) {
    const auto found = columns.find(joint + std::string(suffix));
    if (found != columns.end()) {
      indices.push_back(found->second);
    } else if (missing.empty()) {
      missing = joint + std::string(suffix);
    }
  }
  if (!indices.empty() && !missing.empty()) {
    throw Error("column " + in_quotes(missing) + " is missing; all joints have " +
                std::string(suffix) + " columns, or none has");
  }
  return indices;
}

std::vector<Configuration> configurations(const CsvTable& table, const Indices& columns) {
  std::vector<Configuration> rows;
  if (columns.empty()) return rows;
  rows.reserve(table.rows.size());
  for (const std::vector<double>& row : table.rows) {
    Configuration& values = rows.emplace_back(static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      values[static_cast<Eigen::Index>(k)] = row[columns[k]];
    }
  }
  return rows;
}

std::vector<double> read_times(const CsvTable& table, std::size_t column) {
  std::vector<double> times;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double time = table.rows[row][column];
    if (row > 0 && !(time > times.back())) {
      throw FileError(table.path, table.lines[row],
                      "column t: time " + exact(time) + " is not after " + exact(times.back()) +
                          "; times must increase");
    }
    times.push_back(time);
  }
  return times;
}

/// Refuses names that would read back as other columns.
void check_names(const std::vector<std::string>& joints) {
  const std::unordered_set<std::string> names(joints.begin(), joints.end());
  for (const std::string& joint : joints) {
    const std::string other = joint_of_rate(joint);
    if (joint != "t" && !names.contains(other)) continue;
    throw Error("joint " + in_quotes(joint) +
                " cannot be written to a .csv file, where this is the " +
                (joint == "t" ? "time" : "name of a column of joint " + in_quotes(other)) +
                "; write .json instead");
  }
}

/// Returns the columns of positions: all except those named by another column and a suffix.
Indices position_columns(const CsvTable& table, const Columns& columns) {
  Indices joints;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i];
    if (!columns.contains(name) || columns.contains(joint_of_rate(name))) continue;
    joints.push_back(i);
    names.insert(name);
  }
  for (const auto& [name, index] : columns) {
    if (names.contains(name) || names.contains(joint_of_rate(name))) continue;
    throw Error("column " + in_quotes(name) + " does not belong to a joint");
  }
  if (joints.empty()) throw Error("there are no columns besides \"t\"");
  return joints;
}

void append(std::string& text, const Configuration& values) {
  for (const double value : values) text += ',' + exact(value);
}

}  // namespace

Trajectory trajectory_from_csv(std::string_view text, const std::string& path) {
  const CsvTable table = parse_csv(text, path);
  Columns columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) columns.emplace(table.columns[i], i);
  Trajectory trajectory;
  try {
    const auto time = columns.find("t");
    if (time == columns.end()) throw Error("column \"t\" is missing: seconds, increasing");
    trajectory.times = read_times(table, time->second);
    columns.erase(time);
    const Indices joints = position_columns(table, columns);
    for (const std::size_t i : joints) trajectory.joint_names.push_back(table.columns[i]);
    trajectory.positions = configurations(table, joints);
    trajectory.velocities =
        configurations(table, rate_columns(trajectory.joint_names, columns, velocity_suffix));
    trajectory.accelerations =
        configurations(table, rate_columns(trajectory.joint_names, columns, acceleration_suffix));
    check_recordable(trajectory);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  return trajectory;
}

std::string trajectory_to_csv(const Trajectory& trajectory) {
  check_recordable(trajectory);
  check_names(trajectory.joint_names);
  const bool velocities = !trajectory.velocities.empty();
  const bool accelerations = !trajectory.accelerations.empty();
  std::string text = "t";
  const auto add_names = [&](std::string_view suffix) {
    for (const std::string& name : trajectory.joint_names) {
      text += ',' + csv_name(name + std::string(suffix));
    }
  };
  add_names("");
  if (velocities) add_names(velocity_suffix);
  if (accelerations) add_names(acceleration_suffix);
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    text += '\n' + exact(trajectory.times[k]);
    append(text, trajectory.positions[k]);
    if (velocities) append(text, trajectory.velocities[k]);
    if (accelerations) append(text, trajectory.accelerations[k]);
  }
  return text + '\n';
}

}  // namespace beeline::internal
