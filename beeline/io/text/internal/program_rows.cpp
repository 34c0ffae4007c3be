#include <algorithm>
#include <array>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/pose_form.h>
#include <beeline/io/text/pose_list.h>

namespace beeline {
namespace {

using internal::in_quotes;
using Columns = std::vector<std::string>;

constexpr std::size_t max_program_rows = 100'000;

const Columns& motions() {
  static const Columns names{"joint",  "around", "line",   "screw", "arc",
                             "spline", "via",    "attach", "detach"};
  return names;
}

const Columns& frames() {
  static const Columns names{"previous", "next"};
  return names;
}

bool has(const Columns& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The columns of a program file: the index of each in a row.
struct ProgramColumns {
  std::array<std::optional<std::size_t>, 8> named;  ///< in the order of program_columns()
  std::vector<std::size_t> pose;                    ///< in the order of the form
  const PoseColumns* form = nullptr;                ///< none: all rows have joint values
  std::vector<double> factors = {};  ///< of each number in a row: pose_factors(), factor_of()
};

ProgramColumns program_columns_of(const Columns& header) {
  ProgramColumns columns{.named = {}, .pose = {}};
  const auto index_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  Columns others;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (!has(program_columns(), header[i])) others.push_back(header[i]);
  }
  for (std::size_t i = 0; i < program_columns().size(); ++i) {
    const std::string& name = program_columns()[i];
    if (has(header, name)) columns.named[i] = index_of(name);
  }
  if (others.empty() && columns.named[2]) return columns;
  columns.form = &internal::pose_columns_of(others);
  for (const std::string& name : columns.form->names) columns.pose.push_back(index_of(name));
  return columns;
}

/// Throws Error for joint values in a column q if a comment gives another unit than the options
/// do: their texts are read by the arm.
void check_joint_values(const internal::StatedUnits& stated, const PoseFormat& format) {
  const internal::Unit* const angle = stated.angle.of(0);
  const internal::Unit* const length = stated.length.of(0);
  if (angle != nullptr && internal::name_of(*angle) != unit_of_column("theta", format)) {
    throw Error("a comment gives angles in " + internal::name_of(*angle) +
                ", but the joint values, q, are in " + unit_of_column("theta", format) +
                " here; an option gives the unit of angles (unit, --degrees)");
  }
  if (length != nullptr && length->si != 1) {
    throw Error(
        "a comment gives lengths in " + internal::name_of(*length) +
        ", but the joint values, q, of prismatic joints are in m; write the unit behind the "
        "names of the other columns");
  }
}

/// Returns what the numbers in the column of speeds, blends or dwells are multiplied by: 1 unless
/// its name or a comment gives a unit. A comment on positions alone does not.
double factor_of(std::size_t column, const std::string& name, const internal::ColumnsInUnits& named,
                 const internal::StatedUnits& stated, const std::string& path) {
  const bool time = name == "dwell";
  const int order = name == "speed" ? 1 : 0;
  const auto quantity = time ? internal::Quantity::time : internal::Quantity::length;
  const internal::Unit* unit = named.units[column];
  if (unit != nullptr) {
    const int power = named.powers[column];
    if (unit->quantity != quantity || (power != order && power != 0)) {
      throw Error("column " + internal::printable(named.given[column]) + " must be in " +
                  (time         ? "s, ms, us or ns"
                   : order == 1 ? "m/s or mm/s"
                                : "m or mm"));
    }
    return unit->si;
  }
  internal::check_read(stated, quantity, order, path);
  unit = time ? stated.time : stated.length.all;
  if (order == 1 && stated.length.of_order[1] != nullptr) unit = stated.length.of_order[1];
  const internal::Unit* const positions = stated.length.of_order[0];
  if (!time && unit == nullptr && positions != nullptr && positions->si != 1) {
    throw Error("a comment gives positions in " + internal::name_of(*positions) +
                ", but no unit of " + name + "; write it behind the column's name, as " +
                (order == 1 ? "speed [mm/s]" : "blend_mm"));
  }
  if (unit == nullptr) internal::check_clear(stated, quantity, path);
  return unit != nullptr ? unit->si : 1;
}

/// Whether each name is a column of a pose or of a program.
bool are_known(const Columns& names) {
  try {
    program_columns_of(internal::known_columns(names).names);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// The number in the i-th of program_columns(); none if there is none.
std::optional<double> optional_number(internal::CsvRows& rows, const ProgramColumns& columns,
                                      std::size_t i, const std::vector<std::string>& items) {
  const std::optional<std::size_t> column = columns.named[i];
  if (!column || items[*column].empty()) return std::nullopt;
  return columns.factors[*column] * rows.number(items[*column], program_columns()[i]);
}

/// The number of leading columns of a form that give the position, if others give the orientation.
std::size_t position_size(const PoseColumns& form) {
  if (!form.oriented || form.form == PoseForm::matrix) return form.names.size();
  return form.planar ? 2 : 3;
}

/// Returns the pose of a row. If its orientation does not count, its items may be empty; the
/// orientation is then the frame's.
std::optional<WrittenPose> pose_in(internal::CsvRows& rows, const std::vector<std::string>& items,
                                   const ProgramColumns& columns, const Columns& header,
                                   const PoseFormat& format, bool orientation_counts) {
  if (columns.form == nullptr) return std::nullopt;
  std::vector<double> numbers;
  const auto is_empty = [&](std::size_t i) { return items[i].empty(); };
  if (std::all_of(columns.pose.begin(), columns.pose.end(), is_empty)) return std::nullopt;
  const auto orientation =
      columns.pose.begin() + static_cast<std::ptrdiff_t>(position_size(*columns.form));
  const bool position_only =
      !orientation_counts && std::all_of(orientation, columns.pose.end(), is_empty);
  for (auto i = columns.pose.begin(); i != (position_only ? orientation : columns.pose.end());
       ++i) {
    numbers.push_back(columns.factors[*i] * rows.number(items[*i], header[*i]));
  }
  if (numbers.size() < columns.pose.size()) {
    numbers.resize(columns.pose.size());
    if (columns.form->form == PoseForm::quaternion) numbers[3] = 1;
  }
  WrittenPose written = written_pose(numbers, *columns.form, format);
  written.pose = checked_pose(written.pose);
  return written;
}

/// The names between commas.
std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', begin), end);
    const std::size_t last = end > first ? text.find_last_not_of(' ', end - 1) + 1 : first;
    if (last == first) throw Error("column touch has an empty name");
    names.push_back(text.substr(first, last - first));
    begin = end + 1;
  }
  return names;
}

/// Checks the items of a row that attaches or detaches a part, or that they are of no other row.
void check_part(const ProgramRow& row) {
  if (!row.is_of_part()) {
    if (row.part.empty() && row.touch.empty()) return;
    throw Error("part and touch are for rows with the motion attach or detach");
  }
  if (row.part.empty()) {
    throw Error(row.motion + " needs the name of an obstacle, in a column part");
  }
  if (row.pose || !row.q.empty() || !row.relative.empty() || row.speed || row.blend || row.dwell) {
    throw Error(row.motion + " moves nothing: this row has only a part, and touch to attach it");
  }
  if (row.motion == "detach" && !row.touch.empty()) {
    throw Error("touch is for attach: a part that is detached is an obstacle again");
  }
}

void check_row(const ProgramRow& row) {
  if (!row.motion.empty() && !has(motions(), row.motion)) {
    throw unknown_name("motion", row.motion, motions());
  }
  if (!row.relative.empty() && !has(frames(), row.relative)) {
    throw unknown_name("relative", row.relative, frames());
  }
  check_part(row);
  if (row.is_of_part()) return;
  if (!row.pose && row.q.empty()) {
    throw Error("this row has neither a pose nor, in a column q, joint values");
  }
  if (row.pose && !row.q.empty()) throw Error("this row has both a pose and joint values, q");
  if (!row.q.empty() && row.motion != "joint" && row.motion != "around") {
    throw Error("joint values, q, are for rows with the motion joint or around");
  }
  if (row.motion == "via" && (row.speed || row.blend || row.dwell)) {
    throw Error("a via row has no speed, blend or dwell: those are the arc's");
  }
  if (row.relative.empty()) return;
  if (!row.pose) throw Error("a row with relative needs a pose");
  if (!row.pose->oriented) {
    throw Error(std::string("relative is for poses with an orientation: x,y,theta or ") +
                internal::spatial_forms);
  }
}

ProgramRow row_in(internal::CsvRows& rows, const ProgramColumns& columns, const Columns& header,
                  const PoseFormat& format) {
  std::vector<std::string> items;
  rows.items(items);
  const auto text = [&](std::size_t i) {
    return columns.named[i] ? items[*columns.named[i]] : std::string();
  };
  ProgramRow row{.motion = text(0),
                 .relative = text(1),
                 .pose = pose_in(rows, items, columns, header, format, text(0) != "via"),
                 .q = text(2),
                 .speed = optional_number(rows, columns, 3, items),
                 .blend = optional_number(rows, columns, 4, items),
                 .dwell = optional_number(rows, columns, 5, items),
                 .part = text(6),
                 .touch = names_in(text(7))};
  check_row(row);
  return row;
}

}  // namespace

const Columns& program_columns() {
  static const Columns columns{"motion", "relative", "q",    "speed",
                               "blend",  "dwell",    "part", "touch"};
  return columns;
}

bool is_program(std::string_view text) {
  try {
    const std::string path;
    internal::CsvLines lines(text, path);
    const internal::CsvRows rows(lines, path, {{}, are_known});
    const Columns header = internal::known_columns(rows.columns()).names;
    return std::any_of(header.begin(), header.end(),
                       [](const std::string& name) { return has(program_columns(), name); });
  } catch (const Error&) {  // its reader says what is wrong
    return false;
  }
}

ProgramRows program_rows_from_csv(std::string_view text, const std::string& path,
                                  const PoseFormat& format) {
  internal::CsvLines lines(text, path);
  internal::CsvRows rows(lines, path, {{}, are_known});
  ProgramRows program{.path = path, .rows = {}};
  try {
    const internal::ColumnsInUnits named = internal::known_columns(rows.columns());
    const Columns& header = named.names;
    ProgramColumns columns = program_columns_of(header);
    if (columns.named[2]) check_joint_values(rows.stated(), format);
    columns.factors = internal::pose_factors(named, format, rows.stated(), path);
    for (const std::size_t i : {3, 4, 5}) {
      const std::optional<std::size_t> column = columns.named[i];
      if (!column) continue;
      columns.factors[*column] =
          factor_of(*column, program_columns()[i], named, rows.stated(), path);
    }
    while (rows.advance()) {
      program.rows.push_back(row_in(rows, columns, header, format));
      program.rows.back().line = rows.line();
      if (program.rows.size() > max_program_rows) {
        throw Error("a program has at most " + std::to_string(max_program_rows) + " rows");
      }
    }
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, rows.line(), error.what());
  }
  if (program.rows.empty()) throw FileError(path, 0, "has a header but no rows below it");
  return program;
}

ProgramRows read_program_rows(const std::string& path, const PoseFormat& format) {
  return program_rows_from_csv(read_file(path), path, format);
}

}  // namespace beeline
