#include <algorithm>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/internal/joint_state_rows.h>
#include <beeline/io/internal/joint_states.h>
#include <beeline/io/internal/known_units.h>
#include <beeline/io/internal/pose_table.h>
#include <beeline/io/internal/position_columns.h>
#include <beeline/io/internal/recorded_units.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/stated_units.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline {
namespace {

/// A recording as the file has it.
struct Content {
  Recording recording;
  internal::RecordedColumns columns;  ///< empty without an arm
  bool table = false;                 ///< otherwise messages of ROS
};

/// Throws FileError if comments give times in another unit than messages have.
void check_message_times(const internal::StatedUnits& stated, const std::string& path) {
  internal::check_read(stated, internal::Quantity::time, 0, path);
  const internal::Unit* const unit = stated.time;
  const auto is = [unit](TimeUnit other) { return unit == &internal::unit_of(other); };
  if (unit == nullptr || is(TimeUnit::seconds) || is(TimeUnit::nanoseconds)) return;
  throw FileError(path, 0,
                  "a comment gives times in " + name_of(*unit) +
                      ", but messages of ROS have seconds and nanoseconds");
}

/// The content of messages in a file with these comments.
Content message(Recording recording, const std::vector<internal::Comment>& comments,
                const std::string& path, const internal::TableOptions& options) {
  const bool seconds = options.time_unit == TimeUnit::seconds;
  if (options.time_unit && !seconds && !options.time_unit_is_optional) {
    throw FileError(
        path, 0,
        std::string("has times in seconds and nanoseconds; ") + internal::time_unit_refusal);
  }
  Content content{std::move(recording), {}, false};
  content.recording.in_time_unit = seconds;
  Trajectory& read = content.recording.trajectory;
  std::vector<std::string> names = read.joint_names;
  internal::StatedUnits stated = internal::stated_units(comments, names, path);
  check_message_times(stated, path);
  for (internal::UnclearComment& unclear : stated.unclear) unclear.times = false;
  if (options.joint_names.empty()) {
    internal::check_without_arm(stated, path);
    return content;
  }
  internal::name_units(stated, names);
  content.columns.joints = internal::columns_in_units(names, options.joint_names);
  content.columns.stated = std::move(stated);
  read.joint_names = content.columns.joints.names;
  return content;
}

Content table(internal::TableRecording read) {
  return {std::move(read.recording), std::move(read.columns), true};
}

/// The content of a source, which is a text and its path or a file, that begins with `front`.
template <class... Source>
Content content_from(const std::string& path, std::string_view front,
                     const internal::TableOptions& options, Source&&... source) {
  const TrajectoryFormat format = trajectory_format(path, front);
  if (format == TrajectoryFormat::json) {
    return message({.trajectory = internal::trajectory_from_json(source...)}, {}, path, options);
  }
  if (format == TrajectoryFormat::yaml) {
    const std::vector<internal::Comment> comments = internal::yaml_comments(front);
    return message(internal::begins_with_joint_state(front)
                       ? internal::recording_from_joint_states(source...)
                       : Recording{.trajectory = internal::trajectory_from_yaml(source...)},
                   comments, path, options);
  }
  if (internal::begins_with_joint_state_rows(front)) {
    return message(internal::recording_from_joint_state_rows(source...), {}, path, options);
  }
  return table(internal::recording_from_csv(source..., options));
}

/// The content of a file; `front` becomes its beginning.
Content content_of_file(const std::string& path, const internal::TableOptions& options,
                        std::string& front) {
  trajectory_format(path, "");  // refuses another ending before the file is read
  InputFile file(path);
  constexpr std::size_t begin = 65536;
  front = file.peek(begin);
  return content_from(path, front, options, file);
}

Content content_of(std::string_view text, const std::string& path,
                   const internal::TableOptions& options) {
  return content_from(path, text, options, text, path);
}

/// Whether the columns, in a comment, are a header: they have all joints, by name or by the map.
bool is_header(const Arm& arm, const JointMap& joint_map, const std::vector<std::string>& names) {
  if (internal::names_all_joints(arm, names)) return true;
  const internal::ColumnsInUnits columns = internal::columns_in_units(names, arm.joint_names());
  return !joint_map.empty() &&
         std::all_of(joint_map.begin(), joint_map.end(), [&columns](const MappedJoint& joint) {
           return internal::mapped_column(columns, joint.name).has_value();
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

/// Throws Error if a comment contradicts the unit of angles that the options state.
void check_stated(const internal::StatedUnits& stated, const RecordingOptions& options) {
  const double given = options.match.angle_unit;
  const bool known = options.angle_unit_is_known || given != 1;
  const internal::Unit* const angle = stated.angle.of(0);
  if (!known || angle == nullptr || angle->si == given) return;
  throw Error("a comment gives angles in " + name_of(*angle) +
              ", but the option angle_unit (--angle-unit) gives another unit");
}

/// Notes the rates that are not read.
void note_unread_rates(const internal::ColumnsInUnits& columns, const internal::JointColumns& order,
                       const std::string& path, std::vector<RecordingNote>& notes) {
  if (order.unread_rates.empty()) return;
  RecordingNote note{.kind = RecordingNoteKind::unread_rates, .path = path};
  for (const Eigen::Index i : order.unread_rates) {
    note.columns.push_back(columns.given[static_cast<std::size_t>(i)]);
  }
  notes.push_back(std::move(note));
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
  const internal::ColumnsInUnits& columns = content.columns.joints;
  check_stated(content.columns.stated, options);
  const internal::JointColumns order = internal::joint_columns(arm, columns.names, match.joint_map);
  if (match.joint_map.empty()) internal::check_positions(arm, columns, order);
  note_unread_rates(columns, order, path, recording.notes);
  const internal::KnownUnits units = internal::known_units(
      arm, path, content.columns, order, match.joint_map, recorded, options, recording.notes);
  match.column_units = units.column_units;
  recording.trajectory = matched_to(arm, recorded, match);
  const auto add = [&](const internal::UnitEvidence& evidence, RecordingNoteKind kind) {
    recording.notes.push_back(note_on(evidence, arm, path, kind));
  };
  const JointMap& known = units.joints;
  const bool assumed = match.angle_unit == 1 && !options.angle_unit_is_known;
  if (assumed) {
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
    } else if (options.detect_degrees && !is_planned_motion(arm, columns, recorded) &&
               internal::may_be_in_degrees(arm, found, known)) {
      recording.notes.push_back({.kind = RecordingNoteKind::read_in_radians, .path = path});
    }
  }
  internal::convert_rates(arm, units, match.angle_unit, recording.trajectory);
  internal::note_missing_units(arm, path, units, content.columns.stated,
                               {match.angle_unit, assumed}, recording.notes);
  const auto millimetres = internal::evidence_of_millimetres(arm, recording.trajectory, known);
  if (millimetres) add(*millimetres, RecordingNoteKind::likely_millimetres);
}

/// The joint map with the names of the columns that it means, unless it is for another file.
JointMap map_of_file(const internal::ColumnsInUnits& columns, const RecordingOptions& options) {
  JointMap joint_map = options.match.joint_map;
  bool any = false;
  for (MappedJoint& joint : joint_map) {
    const auto column = internal::mapped_column(columns, joint.name);
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
  match.joint_map = map_of_file(content.columns.joints, options);
  recording.mapped = !match.joint_map.empty();
  try {
    match_in_units(arm, path, recorded, content, std::move(match), options, recording);
  } catch (const FileError&) {
    throw;
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
  std::string front;
  return content_of_file(path, {}, front).recording.trajectory;
}

Trajectory parse_trajectory(std::string_view text, const std::string& path) {
  return content_of(text, path, {}).recording.trajectory;
}

Recording read_recording(const std::string& path, const Arm& arm, const RecordingOptions& options) {
  std::string front;
  try {
    return matched(content_of_file(path, table_options(arm, options), front), path, arm, options);
  } catch (const FileError&) {
    internal::refuse_poses(front, path, arm);
    throw;
  }
}

Recording parse_recording(std::string_view text, const std::string& path, const Arm& arm,
                          const RecordingOptions& options) {
  try {
    return matched(content_of(text, path, table_options(arm, options)), path, arm, options);
  } catch (const FileError&) {
    internal::refuse_poses(text, path, arm);
    throw;
  }
}

bool lacks_times(const std::string& path) {
  constexpr std::size_t begin = 4096, max_line = std::size_t{1} << 20;
  InputFile file(path);
  if (!file.size()) return false;
  const std::string_view front = file.peek(begin);
  if (trajectory_format(path, front) != TrajectoryFormat::csv) return false;
  if (internal::begins_with_joint_state_rows(front)) return false;
  try {
    internal::CsvLines lines(file, max_line);
    const internal::CsvRows rows(lines, path, {{}, internal::names_times});
    return !internal::names_times(rows.columns());
  } catch (const Error&) {
    return false;  // read_recording() names the mistake
  }
}

}  // namespace beeline
