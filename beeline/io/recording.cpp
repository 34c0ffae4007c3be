#include <algorithm>
#include <iterator>
#include <numbers>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/joint_states.h>
#include <beeline/io/internal/recorded_units.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline {
namespace {

/// A recording as the file has it.
struct Content {
  Recording recording;
  internal::ColumnsInUnits columns;  ///< of the trajectory's joints; empty without an arm
  bool table = false;                ///< otherwise messages of ROS
  internal::StatedUnits stated = {};
};

Content message(Recording recording, const std::string& path,
                const internal::TableOptions& options) {
  const bool seconds = options.time_unit == TimeUnit::seconds;
  if (options.time_unit && !seconds && !options.time_unit_is_optional) {
    throw FileError(
        path, 0,
        std::string("has times in seconds and nanoseconds; ") + internal::time_unit_refusal);
  }
  Content content{std::move(recording), {}, false};
  content.recording.in_time_unit = seconds;
  if (!options.joint_names.empty()) {
    Trajectory& read = content.recording.trajectory;
    content.columns = internal::columns_in_units(read.joint_names, options.joint_names);
    read.joint_names = content.columns.names;
  }
  return content;
}

Content table(internal::TableRecording read) {
  return {std::move(read.recording), std::move(read.columns), true, read.stated};
}

/// The content of a source, which is a text and its path or a file, that begins with `front`.
template <class... Source>
Content content_from(const std::string& path, std::string_view front,
                     const internal::TableOptions& options, Source&&... source) {
  switch (trajectory_format(path, front)) {
    case TrajectoryFormat::json:
      return message({.trajectory = internal::trajectory_from_json(source...)}, path, options);
    case TrajectoryFormat::yaml:
      return message(internal::begins_with_joint_state(front)
                         ? internal::recording_from_joint_states(source...)
                         : Recording{.trajectory = internal::trajectory_from_yaml(source...)},
                     path, options);
    default:
      return table(internal::recording_from_csv(source..., options));
  }
}

Content content_of_file(const std::string& path, const internal::TableOptions& options) {
  trajectory_format(path, "");  // refuses another ending before the file is read
  InputFile file(path);
  constexpr std::size_t begin = 65536;
  const std::string front(file.peek(begin));
  return content_from(path, front, options, file);
}

Content content_of(std::string_view text, const std::string& path,
                   const internal::TableOptions& options) {
  return content_from(path, text, options, text, path);
}

/// The column of the recording that a name of the joint map means; none if there is none.
std::optional<std::size_t> mapped_column(const internal::ColumnsInUnits& columns,
                                         const std::string& name) {
  for (const auto* names : {&columns.given, &columns.names}) {
    const auto found = std::find(names->begin(), names->end(), name);
    if (found != names->end()) return static_cast<std::size_t>(found - names->begin());
  }
  for (const auto* names : {&columns.given, &columns.names}) {
    const auto is_name = [&name](const std::string& other) {
      return internal::same_ignoring_case(other, name);
    };
    if (std::count_if(names->begin(), names->end(), is_name) != 1) continue;
    const auto found = std::find_if(names->begin(), names->end(), is_name);
    return static_cast<std::size_t>(found - names->begin());
  }
  return std::nullopt;
}

/// Whether the columns, in a comment, are a header: they have all joints, by name or by the map.
bool is_header(const Arm& arm, const JointMap& joint_map, const std::vector<std::string>& names) {
  if (internal::names_all_joints(arm, names)) return true;
  const internal::ColumnsInUnits columns = internal::columns_in_units(names, arm.joint_names());
  return !joint_map.empty() &&
         std::all_of(joint_map.begin(), joint_map.end(), [&columns](const MappedJoint& joint) {
           return mapped_column(columns, joint.name).has_value();
         });
}

/// `arm` and `options` must outlive the result.
internal::TableOptions table_options(const Arm& arm, const RecordingOptions& options) {
  return {.joint_names = arm.joint_names(),
          .is_header =
              [&arm, &options](const std::vector<std::string>& names) {
                return is_header(arm, options.match.joint_map, names);
              },
          .time_unit = options.time_unit,
          .time_unit_is_optional = options.time_unit_is_optional,
          .needs_times = options.needs_times};
}

/// The unit of a joint's values.
struct JointUnitSource {
  const internal::Unit* unit = nullptr;
  std::string column = {};  ///< whose name gives it; empty: a comment does
};

/// Throws Error for a unit that the joint does not have.
void check_unit(const Joint& joint, const std::string& column, const internal::Unit& unit) {
  const bool slides = kind(joint) == JointKind::prismatic;
  if (slides != (unit.quantity == internal::Quantity::angle)) return;
  throw Error("column " + internal::in_quotes(column) + " is in " + name_of(unit) + ", but joint " +
              joint.name + (slides ? " slides: m or mm" : " turns: rad or deg"));
}

/// The unit that the columns of joint k or a comment give. The columns that give none get it.
JointUnitSource complete_unit(const Joint& joint, const internal::JointColumns& order,
                              std::size_t k, const internal::StatedUnits& stated,
                              internal::ColumnsInUnits& recorded) {
  std::vector<std::size_t> own;
  for (const auto* columns : {&order.positions, &order.velocities, &order.accelerations}) {
    if (!columns->empty()) own.push_back(static_cast<std::size_t>((*columns)[k]));
  }
  JointUnitSource found;
  for (const std::size_t i : own) {
    if (found.unit == nullptr && recorded.units[i] != nullptr) {
      found = {recorded.units[i], recorded.sources[i]};
    }
  }
  const bool slides = kind(joint) == JointKind::prismatic;
  const internal::Unit* const by_comment = slides ? stated.length : stated.angle;
  if (found.unit != nullptr && by_comment != nullptr && found.unit != by_comment) {
    throw Error("column " + internal::in_quotes(found.column) + " is in " + name_of(*found.unit) +
                ", but a comment says " + name_of(*by_comment));
  }
  if (found.unit == nullptr) found.unit = by_comment;
  for (const std::size_t i : own) {
    if (recorded.units[i] == nullptr) recorded.units[i] = found.unit;
  }
  return found;
}

/// Throws Error if a comment contradicts the unit of angles that the options state.
void check_stated(const internal::StatedUnits& stated, const RecordingOptions& options) {
  const double given = options.match.angle_unit;
  const bool known = options.angle_unit_is_known || given != 1;
  if (!known || stated.angle == nullptr || stated.angle->si == given) return;
  throw Error("a comment gives angles in " + name_of(*stated.angle) +
              ", but the option angle_unit (--angle-unit) gives another unit");
}

/// Adds a note on the unit to the notes from the first one on.
void add_note(const JointUnitSource& source, const std::string& path, std::size_t first,
              std::vector<RecordingNote>& notes) {
  const auto unit = static_cast<JointUnit>(source.unit - &internal::all_units().front());
  auto note = std::find_if(notes.begin() + static_cast<std::ptrdiff_t>(first), notes.end(),
                           [&](const RecordingNote& other) {
                             return other.joint_unit == unit &&
                                    other.columns.empty() == source.column.empty();
                           });
  if (note == notes.end()) {
    notes.push_back({.kind = RecordingNoteKind::named_unit, .path = path, .joint_unit = unit});
    note = std::prev(notes.end());
  }
  if (!source.column.empty()) note->columns.push_back(source.column);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(), [&name](const std::string& other) {
    return internal::same_ignoring_case(other, name);
  });
}

/// Throws Error if the arm's own names are columns beside the columns that are read as positions.
void check_plain_names(const Arm& arm, const std::vector<std::string>& names,
                       const internal::JointColumns& order) {
  const std::string& read = names[static_cast<std::size_t>(order.positions.front())];
  const std::vector<std::string> joints = arm.joint_names();
  if (internal::same_ignoring_case(read, joints.front())) return;
  const auto is_column = [&names](const std::string& joint) { return contains(names, joint); };
  if (!std::all_of(joints.begin(), joints.end(), is_column)) return;
  throw Error("columns " + internal::in_quotes(joints.front()) + " and " +
              internal::in_quotes(read) + " may both be positions of joint " + joints.front() +
              "; a joint map (joint_map, --joint-map) names the columns to read");
}

/// Throws Error for a column of positions whose name states another quantity or unit, apart from
/// the joint's name.
void check_quantities(const Arm& arm, const internal::ColumnsInUnits& columns,
                      const internal::JointColumns& order) {
  const std::vector<std::vector<std::string>> namings = joint_namings(arm);
  for (std::size_t k = 0; k < order.positions.size(); ++k) {
    const auto column = static_cast<std::size_t>(order.positions[k]);
    std::string rest = internal::lower_case(columns.names[column]);
    for (const std::vector<std::string>& naming : namings) {
      const std::string joint = internal::lower_case(naming[k]);
      const std::size_t begin = rest.rfind(joint);
      if (begin == std::string::npos) continue;
      rest.replace(begin, joint.size(), " ");
      break;
    }
    const std::string_view word = internal::other_quantity_in(rest);
    if (word.empty()) continue;
    throw Error("column " + internal::in_quotes(columns.given[column]) + " says " +
                internal::in_quotes(std::string(word)) +
                ", so it is not read as positions in rad, deg, m or mm; a joint map (joint_map, "
                "--joint-map) reads it nevertheless");
  }
}

/// Sets the units of the columns that names or comments give, with a note for each unit. Returns
/// the joint map with these units, for the evidence of others.
JointMap set_known_units(const Arm& arm, const std::string& path, const Content& content,
                         MatchOptions& match, std::vector<RecordingNote>& notes) {
  internal::ColumnsInUnits recorded = content.columns;
  const internal::JointColumns order =
      internal::joint_columns(arm, recorded.names, match.joint_map);
  if (match.joint_map.empty()) {
    check_plain_names(arm, recorded.names, order);
    check_quantities(arm, recorded, order);
  }
  JointMap known = match.joint_map;
  known.resize(order.positions.size());
  const std::size_t first_note = notes.size();
  for (std::size_t k = 0; k < known.size(); ++k) {
    const Joint& joint = arm.joint_of(static_cast<Eigen::Index>(k));
    const bool mapped = known[k].unit.has_value();
    const JointUnitSource source =
        complete_unit(joint, order, k, mapped ? internal::StatedUnits() : content.stated, recorded);
    if (mapped || source.unit == nullptr) continue;
    check_unit(joint, source.column, *source.unit);
    known[k].unit = source.unit->si;
    add_note(source, path, first_note, notes);
  }
  for (const internal::Unit* unit : recorded.units) {
    match.column_units.push_back(unit != nullptr ? std::optional(unit->si) : std::nullopt);
  }
  return known;
}

RecordingNote note_on(const internal::UnitEvidence& evidence, const Arm& arm,
                      const std::string& path, RecordingNoteKind kind) {
  return {.kind = kind,
          .path = path,
          .joint = arm.joint_of(evidence.coordinate).name,
          .value = evidence.value};
}

/// Whether the recording has all columns of a planned motion that this library has written, and so
/// is in radians.
bool is_planned_motion(const Arm& arm, const internal::ColumnsInUnits& columns,
                       const Trajectory& recorded) {
  return columns.given == arm.joint_names() && !recorded.accelerations.empty();
}

/// Matches `recorded` to the arm: in degrees where only degrees are possible and the options ask
/// for it. Adds notes on units.
void match_in_units(const Arm& arm, const std::string& path, const Trajectory& recorded,
                    const Content& content, MatchOptions match, const RecordingOptions& options,
                    Recording& recording) {
  check_stated(content.stated, options);
  const JointMap known = set_known_units(arm, path, content, match, recording.notes);
  recording.trajectory = matched_to(arm, recorded, match);
  const auto add = [&](const internal::UnitEvidence& evidence, RecordingNoteKind kind) {
    recording.notes.push_back(note_on(evidence, arm, path, kind));
  };
  if (match.angle_unit == 1 && !options.angle_unit_is_known) {
    const Trajectory& found = recording.trajectory;
    const auto degrees = internal::evidence_of_degrees(arm, found, known);
    const auto revolutions =
        internal::evidence_of_revolutions(arm, found, known, recording.has_times);
    if (degrees && options.detect_degrees) {
      add(*degrees, RecordingNoteKind::read_in_degrees);
      match.angle_unit = std::numbers::pi / 180;
      recording.trajectory = matched_to(arm, recorded, match);
    } else if (degrees) {
      add(*degrees, RecordingNoteKind::likely_degrees);
    } else if (revolutions) {
      add(*revolutions, RecordingNoteKind::many_revolutions);
    } else if (options.detect_degrees && !is_planned_motion(arm, content.columns, recorded) &&
               internal::may_be_in_degrees(arm, found, known)) {
      recording.notes.push_back({.kind = RecordingNoteKind::read_in_radians, .path = path});
    }
  }
  const auto millimetres = internal::evidence_of_millimetres(arm, recording.trajectory, known);
  if (millimetres) add(*millimetres, RecordingNoteKind::likely_millimetres);
}

/// The joint map with the names of the columns that it means, unless it is for another file.
JointMap map_of_file(const internal::ColumnsInUnits& columns, const RecordingOptions& options) {
  JointMap joint_map = options.match.joint_map;
  bool any = false;
  for (MappedJoint& joint : joint_map) {
    const auto column = mapped_column(columns, joint.name);
    any = any || column.has_value();
    if (column) joint.name = columns.names[*column];
  }
  return any || !options.map_is_optional ? joint_map : JointMap();
}

Recording matched(Content content, const std::string& path, const Arm& arm,
                  const RecordingOptions& options) {
  Recording recording = std::move(content.recording);
  MatchOptions match = options.match;
  const Trajectory recorded = std::move(recording.trajectory);
  match.joint_map = map_of_file(content.columns, options);
  recording.mapped = !match.joint_map.empty();
  try {
    match_in_units(arm, path, recorded, content, std::move(match), options, recording);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  if (!content.table || !recording.has_times) return recording;
  if (const auto period = internal::evidence_of_milliseconds(arm, recording.trajectory)) {
    recording.notes.push_back(
        {.kind = RecordingNoteKind::likely_milliseconds, .path = path, .value = *period});
  }
  return recording;
}

}  // namespace

Trajectory read_trajectory(const std::string& path) {
  return content_of_file(path, {}).recording.trajectory;
}

Trajectory parse_trajectory(std::string_view text, const std::string& path) {
  return content_of(text, path, {}).recording.trajectory;
}

Recording read_recording(const std::string& path, const Arm& arm, const RecordingOptions& options) {
  return matched(content_of_file(path, table_options(arm, options)), path, arm, options);
}

Recording parse_recording(std::string_view text, const std::string& path, const Arm& arm,
                          const RecordingOptions& options) {
  return matched(content_of(text, path, table_options(arm, options)), path, arm, options);
}

bool lacks_times(const std::string& path) {
  constexpr std::size_t begin = 4096, max_line = std::size_t{1} << 20;
  InputFile file(path);
  if (!file.size()) return false;
  if (trajectory_format(path, file.peek(begin)) != TrajectoryFormat::csv) return false;
  try {
    internal::CsvLines lines(file, max_line);
    const internal::CsvRows rows(lines, path, {{}, internal::names_times});
    return !internal::names_times(rows.columns());
  } catch (const Error&) {
    return false;  // read_recording() names the mistake
  }
}

}  // namespace beeline
