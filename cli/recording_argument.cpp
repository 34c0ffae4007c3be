#include "recording_argument.h"

#include <cmath>
#include <fmt/format.h>

#include <beeline/error.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

constexpr double max_time = 1e10;  // seconds: times since 1970 are accepted

void check_times(const std::string& path, const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (std::abs(times[i]) <= max_time) continue;
    throw FileError(
        path, 0,
        fmt::format(
            "sample {}: the time {} s is outside -{} to {} s; --time-unit reads ms, us or ns",
            i + 1, number(times[i]), number(max_time), number(max_time)));
  }
}

void check_size(const std::string& path, const Arm& arm, const std::vector<Configuration>& column,
                double largest) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    for (int k = 0; k < arm.dof(); ++k) {
      if (std::abs(column[i][k]) <= largest) continue;
      throw FileError(
          path, 0,
          fmt::format("sample {}: joint {} has the value {}; the largest accepted is {}", i + 1,
                      arm.joint_of(k).name, number(column[i][k]), number(largest)));
    }
  }
}

}  // namespace

const char* const recording_units =
    "Recordings are in radians, metres and seconds, unless the name of a column gives a unit, as "
    "joint1_deg or joint4 (mm), or --joint-map, --angle-unit or --time-unit does. With --degrees "
    "one that gives no unit, and whose angles are out of range in radians but not in degrees, is "
    "read in degrees; any other one is in radians, as all files that beeline writes. stderr says "
    "how it was read.";

std::vector<Option> RecordingArgument::reading_options() {
  return {
      Option("--joint-map FILE|A,B,...",
             "The recording's joints in the arm's order, a minus in front of those with the "
             "opposite direction; its other columns are not read. Or a .json file with {JOINT: "
             "{name, sign, offset, unit}, ...}, by the arm's joints, each optional: the arm's "
             "value is sign * recorded + offset, in the unit rad, deg, m or mm. Default: joints by "
             "name, as the arm or its maker's description for ROS has them.",
             &joint_map),
      Option("--angle-unit UNIT",
             "The unit of the recording's angles, unless the names of its columns or --joint-map "
             "give one; a comment that gives another one is refused. Default: rad; with --degrees "
             "deg, if only degrees are in range.",
             &angle_unit, {.choices = {name(JointUnit::radians), name(JointUnit::degrees)}}),
      Option(
          "--time-unit UNIT",
          "The unit of times in a .csv recording with one column of times; the unit of other "
          "recordings is fixed, and one that contradicts the column's name or a comment is "
          "refused. Default: what the name, as time_ms, or a comment says; otherwise seconds or, "
          "for times since 1970 of the years 1990 to 2100, what their size says.",
          &time_unit, {.choices = time_unit_names()})};
}

std::vector<Option> RecordingArgument::options() {
  return joined(
      {reading_options(),
       {Option("--no-unwrap",
               "Keep the values of continuous joints as recorded. By default, the jumps of values "
               "that stay within one revolution, or within two and jump by two, are taken out "
               "where only that keeps the velocity limits; stderr says so.",
               &no_unwrap)}});
}

Recording RecordingArgument::read(const std::string& path, const Arm& arm, const UnitArgument& unit,
                                  const ReadingNeeds& needs) const {
  RecordingOptions options{.map_is_optional = !needs.joint_map,
                           .time_unit_is_optional = !needs.time_unit,
                           .needs_times = needs.times,
                           .detect_degrees = unit.degrees,
                           .angle_unit_is_known = !angle_unit.empty()};
  if (angle_unit == name(JointUnit::degrees)) {
    options.match.angle_unit = to_radians(1, AngleUnit::degrees);
  }
  if (!joint_map.empty()) options.match.joint_map = read_joint_map(joint_map, arm);
  if (!time_unit.empty()) options.time_unit = time_unit_named(time_unit);
  Recording recording = read_recording(path, arm, options);
  for (const RecordingNote& note : recording.notes) warn(sentence(note, OptionStyle::command));
  const Trajectory& trajectory = recording.trajectory;
  check_times(path, trajectory.times);
  check_size(path, arm, trajectory.positions, Limits::max_position);
  check_size(path, arm, trajectory.velocities, Limits::max_rate);
  check_size(path, arm, trajectory.accelerations, Limits::max_rate);
  return recording;
}

Recording RecordingArgument::read_unwrapped(const std::string& path, const Arm& arm,
                                            const UnitArgument& unit,
                                            const ReadingNeeds& needs) const {
  Recording recording = read(path, arm, unit, needs);
  if (no_unwrap) return recording;
  Unwrapped result = unwrapped(arm, recording.trajectory);
  warn_of_unwrapped(path, result.joints);
  recording.trajectory = std::move(result.trajectory);
  return recording;
}

void warn_of_unwrapped(const std::string& path, const std::vector<UnwrappedJoint>& joints) {
  for (const auto& [joint, wraps, first_time] : joints) {
    warn(
        fmt::format("{}: the values of joint {} wrap {}, at {}{} s; they are unwrapped, as only "
                    "this keeps its velocity limit",
                    path, joint, wraps == 1 ? "once" : fmt::format("{} times", wraps),
                    wraps == 1 ? "" : "first ", number(first_time)));
  }
}

Json json_unwrapped(const std::vector<UnwrappedJoint>& joints) {
  Json list = Json::list();
  for (const auto& [joint, wraps, first_time] : joints) {
    list.append({{"joint", joint}, {"wraps", wraps}, {"first_time", first_time}});
  }
  return list;
}

}  // namespace beeline::command
