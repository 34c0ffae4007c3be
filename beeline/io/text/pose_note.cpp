#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/text/pose_list.h>

namespace beeline {

std::string name(PoseNoteKind kind) {
  constexpr internal::EnumNames<PoseNoteKind> names("kind of note");
  return names.of(kind);
}

std::optional<PoseNote> angle_note(double angle, std::optional<PoseForm> form,
                                   const PoseFormat& format) {
  const bool vector = form == PoseForm::rotvec;  // in radians, whatever the unit of angles is
  if (std::abs(angle) <= plausible_angle) return std::nullopt;
  if (!vector && format.angle_unit == AngleUnit::degrees) return std::nullopt;
  return PoseNote{
      .kind = vector ? PoseNoteKind::long_rotation_vector : PoseNoteKind::likely_degrees,
      .value = angle};
}

std::optional<PoseNote> distance_note(const Arm::Reach& sphere, const Pose& pose,
                                      const PoseFormat& format) {
  const Vector3 position = pose.translation();
  if (format.millimetres || !rather_in_millimetres(sphere, position)) return std::nullopt;
  return PoseNote{.kind = PoseNoteKind::likely_millimetres,
                  .value = (position - sphere.centre).norm()};
}

std::vector<PoseNote> notes_on(const PoseList& list, const PoseFormat& format,
                               const std::optional<Arm::Reach>& sphere) {
  std::vector<PoseNote> notes;
  if (!list.has_header) {
    notes.push_back({.kind = PoseNoteKind::no_header, .columns = list.columns});
  }
  if (list.vector_in_degrees) notes.push_back({.kind = PoseNoteKind::vector_in_degrees});
  if (!list.commented_units.empty()) {
    notes.push_back({.kind = PoseNoteKind::commented_unit, .columns = list.commented_units});
  }
  if (const auto note = angle_note(list.max_angle, list.form, format)) notes.push_back(*note);
  if (!sphere) return notes;
  for (const Pose& pose : list.poses) {
    const auto note = distance_note(*sphere, pose, format);
    if (!note) continue;
    notes.push_back(*note);
    break;
  }
  return notes;
}

std::string sentence(const PoseNote& note, const std::string& where, OptionStyle style) {
  const bool command = style == OptionStyle::command;
  switch (note.kind) {
    case PoseNoteKind::no_header:
      return where + " has no header; its columns are read as " + listed(note.columns);
    case PoseNoteKind::likely_degrees:
      return where + ": an angle of " + number(note.value) + " rad is more than a revolution; " +
             (command ? "--degrees" : "angle_unit=\"degrees\"") + " reads degrees";
    case PoseNoteKind::long_rotation_vector:
      return where + ": a rotation vector of " + number(note.value) +
             " rad is more than a revolution; rx, ry, rz are in radians" +
             (command ? ", also with --degrees" : "");
    case PoseNoteKind::vector_in_degrees:
      return where +
             ": rx, ry, rz in degrees are read as a rotation vector; name rotations about "
             "the fixed axes X, Y, Z roll, pitch, yaw";
    case PoseNoteKind::commented_unit:
      return where + ": columns without a unit are read in " + listed(note.columns) +
             ", as a comment says";
    case PoseNoteKind::likely_millimetres:
      return where + ": a position " + number(note.value) + " m away is probably in millimetres; " +
             (command ? "--millimetres" : "millimetres=True") + " reads millimetres";
  }
  return "";
}

}  // namespace beeline
