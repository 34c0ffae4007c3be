#include <algorithm>
#include <iterator>
#include <numbers>

#include <beeline/error.h>
#include <beeline/read/internal/file_stream.h>
#include <beeline/read/internal/name.h>
#include <beeline/record/internal/recorded_units.h>
#include <beeline/record/internal/time_column.h>
#include <beeline/record/internal/trajectory_csv.h>
#include <beeline/record/internal/trajectory_json.h>
#include <beeline/record/internal/trajectory_yaml.h>
#include <beeline/record/trajectory_file.h>

namespace beeline {
namespace {

constexpr const char* note_names[] = {
    "no_header",        "times_since_1970",   "read_in_degrees",    "likely_degrees",
    "many_revolutions", "likely_millimetres", "likely_milliseconds"};

/// A recording as the file has it.
struct Content {
  Recording recording;
  bool table = false;  ///< otherwise a message of ROS
};

Content message(Trajectory trajectory, const std::string& path,
                const internal::TableOptions& options) {
  const bool seconds = options.time_unit == TimeUnit::seconds;
  if (options.time_unit && !seconds && !options.time_unit_is_optional) {
    throw FileError(
        path, 0,
        std::string("has times in seconds and nanoseconds; ") + internal::time_unit_refusal);
  }
  return {{.trajectory = std::move(trajectory), .in_time_unit = seconds}, false};
}

Content content_of_file(const std::string& path, const internal::TableOptions& options) {
  trajectory_format(path, "");  // refuses another ending before the file is read
  internal::InputFile file(path);
  constexpr std::size_t begin = 4096;  // of a file without an ending
  switch (trajectory_format(path, file.peek(begin))) {
    case TrajectoryFormat::json:
      return message(internal::trajectory_from_json(file), path, options);
    case TrajectoryFormat::yaml:
      return message(internal::trajectory_from_yaml(file), path, options);
    default:
      return {internal::recording_from_csv(file, options), true};
  }
}

Content content_of(std::string_view text, const std::string& path,
                   const internal::TableOptions& options) {
  switch (trajectory_format(path, text)) {
    case TrajectoryFormat::json:
      return message(internal::trajectory_from_json(text, path), path, options);
    case TrajectoryFormat::yaml:
      return message(internal::trajectory_from_yaml(text, path), path, options);
    default:
      return {internal::recording_from_csv(text, path, options), true};
  }
}

internal::TableOptions table_options(const Arm& arm, const RecordingOptions& options) {
  return {.joint_names = arm.joint_names(),
          .time_unit = options.time_unit,
          .time_unit_is_optional = options.time_unit_is_optional,
          .needs_times = options.needs_times};
}

RecordingNote note_on(const internal::UnitEvidence& evidence, const Arm& arm,
                      const std::string& path, RecordingNoteKind kind) {
  return {.kind = kind,
          .path = path,
          .joint = arm.joint_of(evidence.coordinate).name,
          .value = evidence.value};
}

/// Matches `recorded` to the arm: in degrees where only degrees are possible and the options ask
/// for it. Adds notes on units.
void match_in_units(const Arm& arm, const std::string& path, const Trajectory& recorded,
                    MatchOptions match, bool detect_degrees, Recording& recording) {
  recording.trajectory = matched_to(arm, recorded, match);
  const auto add = [&](const internal::UnitEvidence& evidence, RecordingNoteKind kind) {
    recording.notes.push_back(note_on(evidence, arm, path, kind));
  };
  if (match.angle_unit == 1) {
    const Trajectory& found = recording.trajectory;
    const auto degrees = internal::evidence_of_degrees(arm, found, match.joint_map);
    const auto revolutions =
        internal::evidence_of_revolutions(arm, found, match.joint_map, recording.has_times);
    if (degrees && detect_degrees) {
      add(*degrees, RecordingNoteKind::read_in_degrees);
      match.angle_unit = std::numbers::pi / 180;
      recording.trajectory = matched_to(arm, recorded, match);
    } else if (degrees) {
      add(*degrees, RecordingNoteKind::likely_degrees);
    } else if (revolutions) {
      add(*revolutions, RecordingNoteKind::many_revolutions);
    }
  }
  const auto millimetres =
      internal::evidence_of_millimetres(arm, recording.trajectory, match.joint_map);
  if (millimetres) add(*millimetres, RecordingNoteKind::likely_millimetres);
}

Recording matched(Content content, const std::string& path, const Arm& arm,
                  const RecordingOptions& options) {
  Recording recording = std::move(content.recording);
  MatchOptions match = options.match;
  const Trajectory recorded = std::move(recording.trajectory);
  const std::vector<std::string>& names = recorded.joint_names;
  const auto is_in_file = [&names](const MappedJoint& joint) {
    return std::find(names.begin(), names.end(), joint.name) != names.end();
  };
  if (options.map_is_optional &&
      std::none_of(match.joint_map.begin(), match.joint_map.end(), is_in_file)) {
    match.joint_map.clear();
  }
  recording.mapped = !match.joint_map.empty();
  try {
    match_in_units(arm, path, recorded, match, options.detect_degrees, recording);
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

std::string name(RecordingNoteKind kind) { return note_names[static_cast<std::size_t>(kind)]; }

std::string sentence(const RecordingNote& note) {
  const std::string joint = "joint " + note.joint + " is at " + number(note.value);
  std::vector<std::string> columns;
  for (const std::string& column : note.columns) columns.push_back(internal::printable(column));
  switch (note.kind) {
    case RecordingNoteKind::no_header:
      return note.path + " has no header; its columns are read as " + listed(columns);
    case RecordingNoteKind::times_since_1970:
      return note.path + ": " + (columns.size() == 1 ? "column " : "columns ") + listed(columns) +
             (columns.size() == 1 ? " has" : " have") + " times since 1970 in " + note.unit +
             ", which count from the first sample";
    case RecordingNoteKind::read_in_degrees:
      return note.path + " is read in degrees: " + joint +
             ", more than a revolution out of range in radians";
    case RecordingNoteKind::likely_degrees:
      return note.path + ": " + joint + ", out of range in radians but not in degrees";
    case RecordingNoteKind::many_revolutions:
      return note.path + ": " + joint + " rad, more than two revolutions, but degrees of one";
    case RecordingNoteKind::likely_millimetres:
      return note.path + ": " + joint + " m, which is out of range but not in millimetres";
    case RecordingNoteKind::likely_milliseconds:
      break;
  }
  return note.path + ": the samples are " + number(note.value) +
         " s apart on average, and no joint reaches 0.2 % of its velocity limit";
}

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

}  // namespace beeline
