#include "bindings.h"
#include "interruption.h"
#include "recording_fields.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

/// A joint map as text, for read_joint_map(), or a list of names and joints.
JointMap joint_map_from(const Arm& arm, nb::handle value) {
  if (value.is_none()) return {};
  if (PyUnicode_Check(value.ptr())) {
    return read_joint_map(Value<std::string>::from(value, "joint_map"), arm);
  }
  if (!is_list(value)) {
    raise_type("joint_map", "a text or a list", value);
  }
  JointMap map;
  for (nb::handle item : nb::borrow(value)) {
    map.push_back(PyUnicode_Check(item.ptr())
                      ? mapped_joint(Value<std::string>::from(item, "joint_map"))
                      : Value<MappedJoint>::from(item, "joint_map"));
  }
  return map;
}

/// The unit of angles: radians by default. `unit` is the former name of the keyword.
AngleUnit angle_unit_from(nb::handle angle_unit, nb::handle unit) {
  refuse_former(unit, "unit", "angle_unit");
  return Value<std::optional<AngleUnit>>::from(angle_unit, "angle_unit")
      .value_or(AngleUnit::radians);
}

/// The category of warnings about recordings.
nb::object recording_warning() {
  static PyObject* const type = new_warning_category(
      "RecordingWarning",
      "How a recording was read where the file does not say, or what its numbers suggest: its "
      "text, with the attribute note, a RecordingNote.");
  return nb::borrow(type);
}

/// Reads a recording and issues its notes as warnings.
Recording recording_in(const std::string& file, const Arm& arm, const RecordingOptions& options) {
  Recording recording;
  {
    const LockRelease release;
    recording = read_recording(file, arm, options);
  }
  for (const RecordingNote& note : recording.notes) {
    nb::object instance = recording_warning()(sentence(note));
    instance.attr("note") = Value<RecordingNote>::to(note);
    issue_warning(instance);
  }
  return recording;
}

/// The keywords of a reader of recordings.
struct ReadingKeywords {
  nb::handle joint_map, angle_unit, time_unit, unit;

  RecordingOptions options(const Arm& arm) const {
    return {.match = matching(arm, joint_map, angle_unit, unit),
            .time_unit = Value<std::optional<TimeUnit>>::from(time_unit, "time_unit"),
            .angle_unit_is_known = !angle_unit.is_none()};
  }
};

void takes_reading(Signature& signature) {
  takes_matching(signature);
  signature.takes("time_unit", Value<std::optional<TimeUnit>>::argument_type(),
                  "Of times in a table with one column of them; None: by the column's name, or "
                  "else by their size.",
                  "None");
}

Trajectory loaded(const std::string& file, nb::handle arm, const ReadingKeywords& keywords) {
  const Arm* known = arm_of(arm);
  if (known == nullptr && !arm.is_none()) raise_type("arm", "an Arm", arm);
  if (known != nullptr) return recording_in(file, *known, keywords.options(*known)).trajectory;
  const bool plain = keywords.joint_map.is_none() && keywords.time_unit.is_none() &&
                     angle_unit_from(keywords.angle_unit, keywords.unit) == AngleUnit::radians;
  if (!plain) throw Error("joint_map, angle_unit and time_unit need an arm");
  const LockRelease release;
  return read_trajectory(file);
}

constexpr const char* tables =
    "Tables of other programs are read too: the times in a column time or timestamp, other "
    "separators and decimal commas, names in upper or lower case, and with an arm units in names, "
    "as joint1_deg.";

}  // namespace

MatchOptions matching(const Arm& arm, nb::handle joint_map, nb::handle angle_unit,
                      nb::handle unit) {
  return {.joint_map = joint_map_from(arm, joint_map),
          .angle_unit = to_radians(1, angle_unit_from(angle_unit, unit))};
}

void takes_matching(Signature& signature) {
  signature.keywords()
      .takes("joint_map", "str | collections.abc.Sequence[str | MappedJoint] | None",
             "The trajectory's joints in the arm's order, a minus in front of those with the "
             "opposite direction, as a list or separated by commas, or a .json file; other columns "
             "are dropped. None: by name.",
             "None")
      .takes("angle_unit", Value<std::optional<AngleUnit>>::argument_type(),
             "Of angles in the trajectory, unless the names in a file say another. None: radians.",
             "None");
}

void bind_loading(nb::class_<Trajectory>& trajectory) {
  const std::string text = std::string(
                               "Reads a trajectory from a file: .csv, with columns t, then the "
                               "joints' names, NAME_vel and NAME_acc where known; .json and .yaml, "
                               "the message trajectory_msgs/JointTrajectory of ROS. ") +
                           tables +
                           " With an arm the trajectory is matched_to() it; only then may a table "
                           "have no header, and a RecordingWarning is issued for each note of "
                           "read_recording(). Raises FileError for invalid lines, which it names.";
  Signature load("load", "Trajectory", text);
  load.takes("path", path_like, "Its ending determines the format.")
      .takes("arm", "Arm | str | None", "The arm.", "None");
  takes_reading(load);
  define_static(
      trajectory,
      [](nb::handle path, nb::handle arm, nb::handle joint_map, nb::handle angle_unit,
         nb::handle time_unit, nb::handle unit) {
        return loaded(path_from(path, "path"), arm, {joint_map, angle_unit, time_unit, unit});
      },
      load, nb::arg("path"), nb::arg("arm") = nb::none(), nb::kw_only(),
      nb::arg("joint_map") = nb::none(), nb::arg("angle_unit") = nb::none(),
      nb::arg("time_unit") = nb::none(), nb::arg("unit") = nb::none());
}

void bind_recordings(nb::module_& m) {
  m.attr("RecordingWarning") = recording_warning();
  bind_record<RecordingNote>(m);
  bind_record<Recording>(m);
  const std::string text =
      std::string(
          "Reads a recording of an arm, as Trajectory.load() does with an arm, and returns the "
          "notes on how it was read too. A RecordingWarning is issued for each. ") +
      tables + " Raises FileError for invalid lines, which it names.";
  Signature read("read_recording", "Recording", text);
  read.takes("path", path_like, "Its ending determines the format.").takes_arm();
  takes_reading(read);
  read.takes("detect_degrees", "bool",
             "Read a recording that gives no unit in degrees if an angle is more than a revolution "
             "out of its limits in radians, and none in degrees; otherwise a note says that it is "
             "read in radians.",
             "False")
      .takes("needs_times", "bool", "False: a table may be a path, with a row each second.",
             "True");
  define(
      m,
      [](nb::handle path, const Arm& arm, nb::handle joint_map, nb::handle angle_unit,
         nb::handle time_unit, nb::handle detect_degrees, nb::handle needs_times, nb::handle unit) {
        RecordingOptions options =
            ReadingKeywords{joint_map, angle_unit, time_unit, unit}.options(arm);
        options.detect_degrees = Value<bool>::from(detect_degrees, "detect_degrees");
        options.needs_times = Value<bool>::from(needs_times, "needs_times");
        return recording_in(path_from(path, "path"), arm, options);
      },
      read, nb::arg("path"), nb::arg("arm"), nb::kw_only(), nb::arg("joint_map") = nb::none(),
      nb::arg("angle_unit") = nb::none(), nb::arg("time_unit") = nb::none(),
      nb::arg("detect_degrees") = false, nb::arg("needs_times") = true,
      nb::arg("unit") = nb::none());
}

}  // namespace beeline::python
