#pragma once

#include <beeline/io/trajectory_file.h>

#include "signature.h"
#include "trajectory_fields.h"

namespace beeline::python {

/// The keywords joint_map and unit, and their place in a signature.
MatchOptions matching(const Arm& arm, nb::handle joint_map, nb::handle angle_unit, nb::handle unit);
void takes_matching(Signature& signature);

void bind_loading(nb::class_<Trajectory>& trajectory);
void bind_recordings(nb::module_& m);

template <>
inline std::vector<RecordingNoteKind> choices() {
  using enum RecordingNoteKind;
  return {no_header,      times_since_1970, named_unit,         read_in_degrees,    read_in_radians,
          likely_degrees, many_revolutions, likely_millimetres, likely_milliseconds};
}

template <>
inline std::vector<JointUnit> choices() {
  return {JointUnit::radians, JointUnit::degrees, JointUnit::metres, JointUnit::millimetres};
}

template <>
struct Fields<RecordingNote> {
  static constexpr const char* name = "RecordingNote";
  static constexpr const char* doc =
      "How a recording was read where the file does not say, or what its numbers suggest.";
  static constexpr auto all() {
    return std::tuple(
        field("kind", &RecordingNote::kind, "Kind of note."),
        field("path", &RecordingNote::path, "Of the file."),
        field("columns", &RecordingNote::columns,
              "Names of all columns, of those with times, or of those in a unit."),
        field("time_unit", &RecordingNote::time_unit,
              "Of times since 1970; a second column refines them."),
        field("joint_unit", &RecordingNote::joint_unit, "Of the columns."),
        field("joint", &RecordingNote::joint, "Of the arm, whose value suggests a unit."),
        field("value", &RecordingNote::value,
              "Of that joint as recorded, or the mean time between samples, s."));
  }
};

template <>
struct Fields<Recording> {
  static constexpr const char* name = "Recording";
  static constexpr const char* doc = "A trajectory as a program of any kind has recorded it.";
  static constexpr auto all() {
    return std::tuple(
        field("trajectory", &Recording::trajectory, "In the arm's order."),
        field("has_times", &Recording::has_times, "False for a path."),
        field("mapped", &Recording::mapped, "Whether the joint map was used."),
        field("in_time_unit", &Recording::in_time_unit, "Whether time_unit was used."),
        field("notes", &Recording::notes, "How it was read, and what its numbers suggest."));
  }
};

}  // namespace beeline::python
