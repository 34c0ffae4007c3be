#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/csv.h>
#include <beeline/read/name.h>
#include <beeline/read/numbers.h>
#include <beeline/record/recordable.h>
#include <beeline/record/trajectory_csv.h>

namespace beeline {
namespace {

constexpr std::string_view velocity_mark = "_vel";
constexpr std::string_view acceleration_mark = "_acc";

using Places = std::vector<std::size_t>;
using Columns = std::unordered_map<std::string, std::size_t>;

/// The joint whose velocity or acceleration the column would hold; empty when its name has no mark.
std::string marked_joint(const std::string& column) {
  for (const std::string_view mark : {velocity_mark, acceleration_mark}) {
    if (column.ends_with(mark)) return column.substr(0, column.size() - mark.size());
  }
  return {};
}

/// Where the joints' columns with this mark stand; none when there are none. All or nothing.
Places marked_columns(const std::vector<std::string>& joints, const Columns& columns,
                      std::string_view mark) {
  Places places;
  std::string missing;
  for (const std::string& joint : joints) {
    const auto found = columns.find(joint + std::string(mark));
    if (found != columns.end()) {
      places.push_back(found->second);
    } else if (missing.empty()) {
      missing = joint + std::string(mark);
    }
  }
  if (!places.empty() && !missing.empty()) {
    throw Error("column " + in_quotes(missing) + " is missing; " + std::string(mark) +
                " columns stand there for all joints or for none");
  }
  return places;
}

std::vector<Configuration> picked(const CsvTable& table, const Places& places) {
  std::vector<Configuration> rows;
  if (places.empty()) return rows;
  rows.reserve(table.rows.size());
  for (const std::vector<double>& row : table.rows) {
    Configuration& values = rows.emplace_back(static_cast<Eigen::Index>(places.size()));
    for (std::size_t k = 0; k < places.size(); ++k) {
      values[static_cast<Eigen::Index>(k)] = row[places[k]];
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
                      "column t: time " + exact(time) + " does not come after " +
                          exact(times.back()) + "; times must increase");
    }
    times.push_back(time);
  }
  return times;
}

/// Refuses names that would be read back as something else.
void check_names(const std::vector<std::string>& joints) {
  const std::unordered_set<std::string> names(joints.begin(), joints.end());
  for (const std::string& joint : joints) {
    const std::string other = marked_joint(joint);
    if (joint != "t" && !names.contains(other)) continue;
    throw Error("joint " + in_quotes(joint) + " cannot go into a .csv file, where this is the " +
                (joint == "t" ? "time" : "name of a column of joint " + in_quotes(other)) +
                "; write .json instead");
  }
}

/// The columns that hold positions: all but those with another column's name and a mark.
Places position_columns(const CsvTable& table, const Columns& columns) {
  Places joints;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i];
    if (!columns.contains(name) || columns.contains(marked_joint(name))) continue;
    joints.push_back(i);
    names.insert(name);
  }
  for (const auto& [name, place] : columns) {
    if (names.contains(name) || names.contains(marked_joint(name))) continue;
    throw Error("column " + in_quotes(name) + " belongs to no joint");
  }
  if (joints.empty()) throw Error("there are no columns of joints beside \"t\"");
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
    const Places joints = position_columns(table, columns);
    for (const std::size_t place : joints) trajectory.joint_names.push_back(table.columns[place]);
    trajectory.positions = picked(table, joints);
    trajectory.velocities =
        picked(table, marked_columns(trajectory.joint_names, columns, velocity_mark));
    trajectory.accelerations =
        picked(table, marked_columns(trajectory.joint_names, columns, acceleration_mark));
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
  const auto add_names = [&](std::string_view mark) {
    for (const std::string& name : trajectory.joint_names) {
      text += ',' + csv_name(name + std::string(mark));
    }
  };
  add_names("");
  if (velocities) add_names(velocity_mark);
  if (accelerations) add_names(acceleration_mark);
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    text += '\n' + exact(trajectory.times[k]);
    append(text, trajectory.positions[k]);
    if (velocities) append(text, trajectory.velocities[k]);
    if (accelerations) append(text, trajectory.accelerations[k]);
  }
  return text + '\n';
}

}  // namespace beeline
