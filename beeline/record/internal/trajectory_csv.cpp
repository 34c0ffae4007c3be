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

/// Appends the row's values in these columns, if there are any.
void append_values(const std::vector<double>& row, const Indices& columns,
                   std::vector<Configuration>& values) {
  if (columns.empty()) return;
  Configuration& last = values.emplace_back(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    last[static_cast<Eigen::Index>(k)] = row[columns[k]];
}

/// Which columns hold what.
struct Layout {
  std::size_t time = 0;
  Indices positions, velocities, accelerations;
};

void append_row(const std::vector<double>& row, const Layout& layout, Trajectory& trajectory) {
  const double time = row[layout.time];
  if (trajectory.size() > 0 && !(time > trajectory.times.back())) {
    throw Error("column t: time " + exact(time) + " is not after " +
                exact(trajectory.times.back()) + "; times must increase");
  }
  trajectory.times.push_back(time);
  append_values(row, layout.positions, trajectory.positions);
  append_values(row, layout.velocities, trajectory.velocities);
  append_values(row, layout.accelerations, trajectory.accelerations);
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
Indices position_columns(const std::vector<std::string>& all, const Columns& columns) {
  Indices joints;
  std::unordered_set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i];
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

/// Reads the header of a trajectory, whose joints' names are `names` then.
Layout layout_of(const std::vector<std::string>& header, std::vector<std::string>& names) {
  Columns columns;
  for (std::size_t i = 0; i < header.size(); ++i) columns.emplace(header[i], i);
  const auto time = columns.find("t");
  if (time == columns.end()) throw Error("column \"t\" is missing: seconds, increasing");
  Layout layout;
  layout.time = time->second;
  columns.erase(time);
  layout.positions = position_columns(header, columns);
  for (const std::size_t i : layout.positions) names.push_back(header[i]);
  layout.velocities = rate_columns(names, columns, velocity_suffix);
  layout.accelerations = rate_columns(names, columns, acceleration_suffix);
  return layout;
}

void append(std::string& text, const Configuration& values) {
  for (const double value : values) text += ',' + exact(value);
}

Trajectory trajectory_from_lines(CsvLines& lines, const std::string& path) {
  CsvRows rows(lines, path);
  Trajectory trajectory;
  int line = 0;
  try {
    const Layout layout = layout_of(rows.columns(), trajectory.joint_names);
    for (std::vector<double> row; rows.next(row);) {
      line = rows.line();
      append_row(row, layout, trajectory);
    }
    line = 0;
    check_recordable(trajectory);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, line, error.what());
  }
  return trajectory;
}

}  // namespace

Trajectory trajectory_from_csv(std::string_view text, const std::string& path) {
  CsvLines lines(text, path);
  return trajectory_from_lines(lines, path);
}

Trajectory trajectory_from_csv(InputFile& file) {
  constexpr std::size_t max_line = std::size_t{4} << 20;  // 100 000 columns
  CsvLines lines(file, max_line);
  return trajectory_from_lines(lines, file.path());
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
  text += '\n';
  return text;
}

}  // namespace beeline::internal
