#include <algorithm>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/rate_columns.h>
#include <beeline/io/internal/recordable.h>
#include <beeline/io/internal/row_times.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/foreign_unit.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

using Indices = std::vector<std::size_t>;
using Columns = ColumnIndex;

/// Appends the row's values in these columns, if there are any.
void append_values(const std::vector<double>& row, const Indices& columns,
                   std::vector<Configuration>& values) {
  if (columns.empty()) return;
  Configuration& last = values.emplace_back(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    last[static_cast<Eigen::Index>(k)] = row[columns[k]];
  }
}

/// Which columns hold what.
struct Layout {
  std::optional<TimeColumns> times;
  Indices positions = {}, velocities = {}, accelerations = {};
};

void append_row(const std::vector<double>& row, double time, const Layout& layout,
                const std::string& column, Trajectory& trajectory) {
  if (trajectory.size() > 0 && !(time > trajectory.times.back())) {
    throw Error("column " + printable(column) + ": time " + exact(time) + " is not after " +
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
    throw Error::of("path",
                    "joint " + in_quotes(joint) +
                        " cannot be written to a .csv file, where this is the " +
                        (joint == "t" ? "time" : "name of a column of joint " + in_quotes(other)) +
                        "; write .json instead");
  }
}

/// Returns the columns of positions: all columns except the ones named by another column and a
/// suffix.
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
  return joints;
}

/// Whether a column has texts: names of joints or frames, as in tables of ROS's messages.
bool has_texts(const std::string& column) {
  std::string_view stem = column;
  while (!stem.empty() &&
         std::string_view("0123456789[]_.").find(stem.back()) != std::string_view::npos) {
    stem.remove_suffix(1);
  }
  const std::size_t begin = stem.find_last_of("/.");
  const std::string_view last = begin == std::string_view::npos ? stem : stem.substr(begin + 1);
  return last == "name" || last == "frame_id" || last == "child_frame_id";
}

/// The columns of times. In a path T is a joint, if the arm has one of this name.
std::optional<TimeColumns> times_in(const std::vector<std::string>& header,
                                    const TableOptions& options) {
  std::optional<TimeColumns> times = time_columns(header);
  const auto& joints = options.joint_names;
  const bool has_joint = std::find(joints.begin(), joints.end(), "T") != joints.end();
  if (times && header[times->index] == "T" && has_joint && !options.needs_times) return {};
  return times;
}

/// Returns the indices of the columns of quantities. Columns of times are not among them, nor
/// columns of texts and an index, which the rows ignore.
Columns quantity_columns(CsvRows& rows, const std::vector<std::string>& header,
                         const std::optional<TimeColumns>& times, bool may_have_index) {
  Columns columns;
  for (std::size_t i = 0; i < header.size(); ++i) columns.emplace(header[i], i);
  if (times) {
    columns.erase(header[times->index]);
    if (times->finer) columns.erase(header[*times->finer]);
    for (const std::size_t i : times->others) columns.erase(header[i]);
  }
  // Beside a column `t`, as in files of this library, all columns are joints.
  const bool may_have_texts = times && header[times->index] != "t";
  std::vector<bool> texts(header.size());
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool index = may_have_index && i == 0 && header[i] == index_name;
    texts[i] = index || (may_have_texts && has_texts(header[i]));
    if (texts[i]) columns.erase(header[i]);
  }
  rows.ignore(std::move(texts));
  return columns;
}

/// Whether the column has times in a unit that is not read: `time_min`.
bool has_unread_times(const std::string& column) {
  const std::size_t gap = column.find_last_of("_/ ([.");
  if (gap == std::string::npos) return false;
  std::string word = lower_case(column.substr(gap + 1));
  if (word.ends_with(')') || word.ends_with(']')) word.pop_back();
  const ForeignUnit* const unit = foreign_unit(word);
  const std::size_t end = column.find_last_not_of("_/ ([.", gap);
  return unit != nullptr && unit->quantity == Quantity::time && end != std::string::npos &&
         names_times({column.substr(0, end + 1)});
}

[[noreturn]] void refuse_times(const std::vector<std::string>& columns) {
  constexpr std::size_t most = 8;
  std::vector<std::string> shown;
  for (const std::string& column : columns) {
    if (has_unread_times(column)) {
      throw Error("column " + printable(column) +
                  " is in a unit of times that is not read; units of times are s, ms, us and ns");
    }
    if (shown.size() < most) shown.push_back(printable(column));
  }
  const std::size_t others = columns.size() - shown.size();
  throw Error(
      "column \"t\" is missing: seconds, increasing; its name may be time, timestamp, stamp, date, "
      "time_from_start, elapsed or sec, with a unit as in time_ms; the columns are " +
      listed(shown) + (others > 0 ? " and " + std::to_string(others) + " more" : ""));
}

/// The columns of these indices.
ColumnsInUnits selected(const ColumnsInUnits& all, const Indices& indices) {
  ColumnsInUnits columns;
  for (const std::size_t i : indices) {
    columns.names.push_back(all.names[i]);
    columns.given.push_back(all.given[i]);
    columns.units.push_back(all.units[i]);
    columns.powers.push_back(all.powers[i]);
  }
  return columns;
}

/// Reads the header of a trajectory.
Layout layout_of(CsvRows& rows, const TableOptions& options, RecordedColumns& columns) {
  const bool has_arm = !options.joint_names.empty();
  ColumnsInUnits all{.names = rows.columns(), .given = rows.columns()};
  all.units.resize(all.names.size());
  all.powers.resize(all.names.size());
  if (has_arm) all = columns_in_units(rows.columns(), options.joint_names);
  std::vector<std::string> header = with_known_suffixes(all.names);
  Layout layout{.times = times_in(rows.columns(), options)};
  if (!layout.times && options.needs_times) refuse_times(rows.columns());
  Columns quantities = quantity_columns(rows, header, layout.times, has_arm);
  if (has_arm) rename_rates(header, quantities, options.joint_names);
  layout.positions = position_columns(header, quantities);
  if (layout.positions.empty()) {
    throw Error("there are no columns besides " +
                in_quotes(header[layout.times ? layout.times->index : 0]));
  }
  all.names = header;
  columns.joints = selected(all, layout.positions);
  layout.velocities = rate_columns(columns.joints.names, quantities, velocity_suffix);
  layout.accelerations = rate_columns(columns.joints.names, quantities, acceleration_suffix);
  columns.rates = {selected(all, layout.velocities), selected(all, layout.accelerations)};
  return layout;
}

/// The columns that a table without a header may have.
std::vector<std::vector<std::string>> forms_of(const TableOptions& options) {
  std::vector<std::vector<std::string>> forms;
  if (options.joint_names.empty()) return forms;
  std::vector<std::string> form{"t"};
  for (const std::string_view suffix : {std::string_view(), velocity_suffix, acceleration_suffix}) {
    for (const std::string& joint : options.joint_names) {
      form.push_back(joint + std::string(suffix));
    }
    forms.push_back(form);
  }
  if (!options.needs_times) forms.push_back(options.joint_names);
  return forms;
}

void append(std::string& text, const Configuration& values) {
  for (const double value : values) text += ',' + exact(value);
}

/// Whether the names in a comment may be a header.
bool is_header(const std::vector<std::string>& names, const TableOptions& options) {
  if (options.needs_times && !names_times(names)) return false;
  return options.is_header ? options.is_header(names) : names_times(names);
}

TableRecording recording_from_lines(CsvLines& lines, const std::string& path,
                                    const TableOptions& options) {
  CsvRows rows(
      lines, path,
      {.without_header = forms_of(options),
       .accepts = names_times,
       .accepts_comment = [&options](const auto& names) { return is_header(names, options); },
       .has_index = !options.joint_names.empty(),
       .reads_others = !options.needs_times});
  TableRecording table;
  Recording& recording = table.recording;
  Trajectory& trajectory = recording.trajectory;
  if (!rows.has_header()) {
    recording.notes.push_back(
        {.kind = RecordingNoteKind::no_header, .path = path, .columns = rows.columns()});
  }
  int line = 0;
  try {
    const Layout layout = layout_of(rows, options, table.columns);
    trajectory.joint_names = table.columns.joints.names;
    recording.has_times = layout.times.has_value();
    const std::string column = layout.times ? rows.columns()[layout.times->index] : "";
    RowTimes times(layout.times, options, rows, path);
    recording.in_time_unit = times.in_given_unit();
    table.columns.stated = rows.stated();
    if (options.joint_names.empty()) check_without_arm(rows.stated(), path);
    if (!options.joint_names.empty() && rows.columns().front() == index_name) {
      recording.notes.push_back(
          {.kind = RecordingNoteKind::index_column, .path = path, .columns = {index_name}});
    }
    for (std::vector<double> row; rows.next(row);) {
      line = rows.line();
      append_row(row, times.next(row, recording.notes), layout, column, trajectory);
    }
    line = 0;
    times.check_days(trajectory.times);
    check_recordable(trajectory);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, line, error.what());
  }
  return table;
}

}  // namespace

void check_without_arm(const StatedUnits& stated, const std::string& path) {
  std::vector<const Unit*> units;
  for (const OrderedUnits& of : {stated.angle, stated.length}) {
    units.push_back(of.all);
    units.insert(units.end(), of.of_order.begin(), of.of_order.end());
  }
  std::erase_if(units, [](const Unit* unit) { return unit == nullptr || unit->si == 1; });
  for (const UnitOfColumn& column : stated.columns) {
    if (column.unit->quantity != Quantity::time) units.push_back(column.unit);
  }
  if (!units.empty()) {
    throw FileError(path, 0,
                    "a comment gives values in " + name_of(*units.front()) +
                        "; they are read in this unit with an arm only");
  }
  for (int order = 0; order < 3; ++order) check_read(stated, Quantity::angle, order, path);
  for (const Quantity quantity : {Quantity::angle, Quantity::length, Quantity::time}) {
    check_clear(stated, quantity, path);
  }
}

TableRecording recording_from_csv(std::string_view text, const std::string& path,
                                  const TableOptions& options) {
  CsvLines lines(text, path);
  return recording_from_lines(lines, path, options);
}

TableRecording recording_from_csv(InputFile& file, const TableOptions& options) {
  constexpr std::size_t max_line = std::size_t{4} << 20;  // 100 000 columns
  CsvLines lines(file, max_line);
  return recording_from_lines(lines, file.path(), options);
}

Trajectory trajectory_from_csv(std::string_view text, const std::string& path) {
  return recording_from_csv(text, path).recording.trajectory;
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
