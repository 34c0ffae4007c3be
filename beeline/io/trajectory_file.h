#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The format of a trajectory in a file, given by the ending of its path. Numbers read back
/// exactly, times of .json and .yaml to the nanosecond.
///   .csv          columns t, then the joints' names, and NAME_vel, NAME_acc where known;
///                 .txt, .tsv, .dat and .log are read so too
///   .json, .yaml  the message trajectory_msgs/JointTrajectory of ROS, times in whole nanoseconds;
///                 read also messages sensor_msgs/JointState as .yaml, as `ros2 topic echo` prints
///                 them, with lines --- between
enum class TrajectoryFormat { csv, json, yaml };

/// Throws Error for an ending with which no file is written.
TrajectoryFormat trajectory_format(const std::string& path);

/// Returns the format of a file that was read. A file without an ending, such as a pipe, is .json
/// if its text begins with a brace and otherwise .csv; one of JointState messages, also with the
/// ending .txt or .log, is .yaml. Throws FileError for another ending.
TrajectoryFormat trajectory_format(const std::string& path, std::string_view text);

/// Returns the content of a file of this format. Throws Error for a trajectory that is not valid
/// (check_trajectory()), has no samples, or whose joints have names that the format cannot hold.
std::string trajectory_text(const Trajectory& trajectory, TrajectoryFormat format);

/// Writes trajectory_text() to a file, which is replaced as a whole. Throws as trajectory_text(),
/// and FileError when the file cannot be written.
void write_trajectory(const std::string& path, const Trajectory& trajectory);

/// Reads a trajectory of any length, in memory proportional to its numbers;
/// trajectory_format(path, text) gives its format. Throws FileError that names the line and the
/// column or value, or for another ending.
Trajectory read_trajectory(const std::string& path);

/// The same from the text of the file at `path`.
Trajectory parse_trajectory(std::string_view text, const std::string& path);

/// Whether the file, which is no pipe, is a table whose header names no times.
bool lacks_times(const std::string& path);

/// The unit of times in a table.
enum class TimeUnit { seconds, milliseconds, microseconds, nanoseconds };
std::string name(TimeUnit unit);  ///< s, ms, us, ns
std::vector<std::string> time_unit_names();

/// Throws Error listing the names for another name.
TimeUnit time_unit_named(const std::string& name);

/// The unit of joint values in a recording; rates are in it per second.
enum class JointUnit { radians, degrees, metres, millimetres };
std::string name(JointUnit unit);  ///< rad, deg, m, mm

struct RecordingOptions {
  /// Options of matching the joints. The unit of a joint's values is given by the joint map, else
  /// by its column's name, such as joint1_deg, else by a comment, else by `match.angle_unit`. Rates
  /// are in it per second, unless their names or a comment give them another one.
  MatchOptions match = {};
  /// Whether a file that has none of the joint map's names is matched by name, as if there were no
  /// map.
  bool map_is_optional = false;
  /// Unit of the times of a .csv file. Default: the unit in the column's name, such as time_ms, or
  /// in a comment; otherwise seconds or, for times since 1970, the unit inferred from their size. A
  /// unit that contradicts the name or the comment is refused. So is one other than seconds for a
  /// file without times and for a file whose format gives their unit: messages of ROS, as .json,
  /// .yaml, or with columns of seconds and nanoseconds.
  std::optional<TimeUnit> time_unit = std::nullopt;
  /// Whether such a file is read as if no time unit were given.
  bool time_unit_is_optional = false;
  bool needs_times = true;  ///< whether a .csv file must have times; otherwise it may be a path
                            ///< with rows at 0, 1, 2, ... s
  /// Whether a recording that does not give the unit of its angles is read in degrees if they are
  /// out of range in radians but not in degrees, and otherwise in radians. A note states the unit,
  /// unless the recording has the form of a motion that this library has planned: the arm's names
  /// in its order, with velocities and accelerations. If false, a note says where degrees are
  /// likely. Applies if `match.angle_unit` is 1.
  bool detect_degrees = false;
  /// Whether the user has stated `match.angle_unit`. There are then no such notes on angles.
  bool angle_unit_is_known = false;
};

/// The kind of a note on a recording: an assumption about data that the file does not state, or an
/// inference from its numbers.
enum class RecordingNoteKind {
  no_header,           ///< the columns of a table without a header are read as `columns`
  times_since_1970,    ///< the times in `columns`, in `time_unit`, or dates where there is none,
                       ///< count from the first sample
  other_times,         ///< `columns` have times too, which are not read
  index_column,        ///< `columns` number the rows and are not read
  unread_rates,        ///< `columns` are not read: they are not complete, or lack velocities
  named_unit,          ///< `columns` are in `joint_unit`, as their names say; if there are none,
                       ///< a comment gives the unit of the joints' other columns
  named_time_unit,     ///< times are in `time_unit`, as a comment says
  named_rate_unit,     ///< the rates in `columns` are in `joint_unit` per second, as a comment says
  no_unit,             ///< the names of `columns` give no unit, other names do; they are read
                       ///< in `joint_unit`
  unclear_comment,     ///< `comment` is not clear about units; values without a unit are read in
                       ///< `joint_unit` or times in `time_unit`
  read_in_degrees,     ///< because `joint` is at `value`: RecordingOptions::detect_degrees
  read_in_radians,     ///< though degrees are possible too: RecordingOptions::detect_degrees
  likely_degrees,      ///< `joint` is at `value`, out of range in radians but not in degrees
  many_revolutions,    ///< `joint`, without limits, is at `value`: perhaps degrees
  likely_millimetres,  ///< `joint` is at `value`, out of range in metres but not in millimetres
  likely_milliseconds,  ///< the samples are `value` seconds apart, and no joint is fast
};
std::string name(RecordingNoteKind kind);

/// An assumption that was made to read a recording, or an inference from its numbers.
struct RecordingNote {
  RecordingNoteKind kind = RecordingNoteKind::no_header;  ///< kind of the note
  std::string path = {};                                  ///< path of the file
  /// Names of all columns, of the columns with times, of the columns in a unit, or of columns that
  /// are not read.
  std::vector<std::string> columns = {};
  /// Unit of times since 1970 in the first of `columns`, or of all times.
  std::optional<TimeUnit> time_unit = std::nullopt;
  /// Unit of the second of `columns`, which refines the times since 1970.
  std::optional<TimeUnit> finer_unit = std::nullopt;
  std::optional<JointUnit> joint_unit = std::nullopt;  ///< unit of the columns
  std::string comment = {};                            ///< text of a comment
  std::string joint = {};  ///< joint of the arm whose value suggests a unit
  /// Recorded value of that joint, with the signs and offsets of a joint map, or the mean time
  /// between samples, s.
  double value = 0;
};

/// Returns one sentence without a full stop, which begins with the path. It says which option reads
/// the recording otherwise.
std::string sentence(const RecordingNote& note, OptionStyle style = OptionStyle::keyword);

/// A trajectory as a program of any kind has recorded it.
struct Recording {
  Trajectory trajectory;      ///< trajectory with its columns in the arm's order: see matched_to()
  bool has_times = true;      ///< whether the recording has times; false for a path
  bool mapped = false;        ///< whether the joint map was used
  bool in_time_unit = false;  ///< whether `time_unit` was used
  /// Assumptions made to read it, and inferences from its numbers.
  std::vector<RecordingNote> notes = {};
};

/// Reads a recording of an arm. A .csv file may have any of these:
///   - times in a column t, time, timestamp, stamp or time_from_start, with a unit in the name or
///     not, or dates of ISO 8601; seconds and the remainder, or the same times, in a finer unit in
///     two columns, as sec and nanosec or time_s and time_us; dates, and times since 1970 in a
///     smaller unit than seconds, count from the first
///   - semicolons, tabs or blanks between the items, with decimal commas
///   - no header, a column of times first, then the joints in the arm's order; or a header in a
///     comment, which names all joints
///   - joints as matched_to() finds them, with a unit of JointUnit behind the name, as joint1_deg,
///     joint1 (mm), joint1/deg or joint1_vel [deg/s], or of angles in front, as deg_joint1
///   - units in a row below the header, `s,deg,deg`, or in comments before the first row, also of
///     .yaml files, `# units: deg` or `# positions in rad, velocities in deg/s`
///   - what `rostopic echo -p` and `ros2 topic echo --csv` print of sensor_msgs/JointState
///   - a first column without a name, as pandas writes its index, which is not read
///   - rates in columns such as joint1_velocity and acceleration_joint1, and efforts, which are not
///     read
/// Throws as read_trajectory() and, as FileError, matched_to() do.
Recording read_recording(const std::string& path, const Arm& arm,
                         const RecordingOptions& options = {});
/// The same from the text of the file at `path`.
Recording parse_recording(std::string_view text, const std::string& path, const Arm& arm,
                          const RecordingOptions& options = {});

/// Returns the joint of this name, with a minus in front if its sign is -1. Throws Error for a name
/// that is empty or not text.
MappedJoint mapped_joint(std::string_view name);

/// Reads a joint map of an arm: names separated by commas in the arm's order, each with a minus in
/// front if its sign is -1, or the path of a .json file: a name for each joint of the arm, or an
/// object of which all but the name are optional:
///     {"joint1": "A1", "joint2": {"name": "A2", "sign": -1, "offset": 90, "unit": "deg"}, ...}
/// The offset is in the unit, which is rad, deg, m or mm. A joint that the file does not have keeps
/// its name. Throws Error and FileError.
JointMap read_joint_map(const std::string& text, const Arm& arm);

/// The forms in which controllers take a motion.
enum class ControllerForm {
  ros2,      ///< trajectory_msgs/JointTrajectory of ROS 2, as YAML or JSON
  urscript,  ///< Universal Robots: servoj() setpoints
  rapid,     ///< ABB: MoveAbsJ instructions
  krl,       ///< KUKA: PTP instructions
  csv,       ///< setpoints at a constant rate, columns t and the joints' names
};
std::string name(ControllerForm form);
std::vector<std::string> controller_form_names();

/// Throws Error listing the names for another name.
ControllerForm controller_form_named(const std::string& name);

/// The endings of the form's files: script; the first is the default.
std::vector<std::string> controller_file_endings(ControllerForm form);

/// Throws Error, as controller_file() does, unless the form can hold a motion of this arm or this
/// program. Does not need a planned motion.
void check_controller_form(const Arm& arm, ControllerForm form);
void check_controller_form(const Arm& arm, const Program& program, ControllerForm form);

/// Setpoints per second of urscript unless a rate is given: the control rate of the CB3 series.
constexpr double default_urscript_rate = 125;

struct ControllerFileOptions {
  /// Setpoints per second of the motion that the trajectory's columns mean. Default: the
  /// trajectory's own samples; for urscript 125, the control rate of the CB3 series (e-Series:
  /// 500). csv requires a rate.
  std::optional<double> rate = std::nullopt;
  /// The name of a rapid or krl program; default: the file's name without its ending.
  std::string program_name = "beeline_motion";
  /// Pose in the world of the frame in which the poses of a program are written. The file states it
  /// relative to the controller's root frame. Default: the root frame.
  std::optional<Pose> work = std::nullopt;
  std::vector<std::string> remarks = {};  ///< further comments of the file, a line each
  bool comments = true;  ///< whether comments are written; false for ros2 as JSON, which has none
  /// Whether a trajectory that exceeds limits of the arm is written all the same; `not_proved`
  /// names them.
  bool ignore_limits = false;
  /// Fraction, 0 to 0.1, by which velocity, acceleration and jerk may exceed their limits, as for
  /// verify().
  double limit_tolerance = 0;
  /// Largest excess over a position limit at the first sample, 0 to 0.1 rad or m, from which the
  /// motion may recover, as for verify(); `not_proved` says until when. Not for programs.
  double recover = 0;
};

/// A motion in the form that a controller takes.
struct ControllerFile {
  /// Content of the file, with `proof`, `not_proved` and `note` as comments; empty if refused.
  std::string text;
  std::string proof;  ///< guarantees of verify() that hold on the controller
  /// What does not hold there or is not known, each with its reason: limits that the arm does not
  /// have, that the form does not carry or, with `ignore_limits`, that the motion exceeds.
  std::vector<std::string> not_proved;
  std::string note;         ///< conditions that the user must ensure; may be empty
  std::size_t samples = 0;  ///< number of setpoints or moves
  /// Duration, s; with a rate at most one period longer than the trajectory.
  double duration = 0;
  /// Why the trajectory is refused: the first limit of the arm that it exceeds; none if it is not.
  Reason reason = {};

  /// Returns whether there is a file.
  explicit operator bool() const { return !reason; }
};

/// Returns the trajectory in the form that a controller takes, from time 0 at its first sample.
/// The trajectory is verified: one whose positions exceed the limits of the arm is refused and, for
/// ros2, which carries the motion between the samples, one whose velocity, acceleration or jerk
/// does. Limits that the arm does not have are not assumed: `not_proved` names them, and what only
/// samples at another rate exceed.
/// Throws Error for a trajectory that does not fit the arm or that the form cannot hold: urscript,
/// rapid and krl need six revolute joints, none of which follows another, ros2 times below 2^31 s
/// that differ by a nanosecond, and urscript periods of whole control cycles of 2 ms. urscript,
/// rapid and krl set the arm's tool, its pose in ControllerFrames::flange, unless it is the flange;
/// its load is not known here.
ControllerFile controller_file(const Arm& arm, const Trajectory& trajectory, ControllerForm form,
                               const ControllerFileOptions& options = {});

/// Returns a planned program as moves for a controller, from the configuration at which its
/// trajectory begins: joint moves to the planned joint values, the others to their poses in the
/// controller's root frame, ControllerFrames::base, or in `options.work`, with speeds, blends and
/// dwells. The file sets the arm's tool. The mount of the arm in the world has no influence. A move
/// without a speed gets the largest speed of the planned motion. The controller plans all motions
/// again. `samples` is the number of moves, `duration` the duration of the planned motion. Throws
/// Error for a motion that is not complete or not a motion of the program, for an arm that the
/// function above refuses, for ros2, csv and a rate, which need a trajectory, and for a kind of
/// move that the form does not have: screws, and splines except of krl.
ControllerFile controller_file(const Arm& arm, const Program& program, const ProgramMotion& motion,
                               ControllerForm form, const ControllerFileOptions& options = {});

}  // namespace beeline
