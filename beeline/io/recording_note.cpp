#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/internal/joint_unit.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/trajectory_file.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<RecordingNoteKind> note_names("note");

constexpr internal::EnumNames<JointUnit> joint_units("unit", "rad deg m mm");

/// Returns the option that reads the recording otherwise, to be appended to the note.
const char* choice_after(const RecordingNote& note, OptionStyle style) {
  const bool command = style == OptionStyle::command;
  const bool angles =
      note.joint_unit == JointUnit::radians || note.joint_unit == JointUnit::degrees;
  switch (note.kind) {
    case RecordingNoteKind::likely_degrees:
      return command ? "; --degrees reads degrees" : "; angle_unit=\"degrees\" reads degrees";
    case RecordingNoteKind::read_in_radians:
    case RecordingNoteKind::many_revolutions:
      return command ? "; --angle-unit deg reads degrees"
                     : "; angle_unit=\"degrees\" reads degrees";
    case RecordingNoteKind::no_unit:
    case RecordingNoteKind::unclear_comment:
      if (note.time_unit) return command ? "; --time-unit gives it" : "; time_unit gives it";
      if (angles) return command ? "; --angle-unit gives it" : "; angle_unit gives it";
      return command ? "; a --joint-map file gives it" : "; a joint_map gives it";
    case RecordingNoteKind::likely_millimetres:
      return command ? "; the unit mm in a --joint-map file reads millimetres"
                     : "; the unit 0.001 in a joint_map reads millimetres";
    case RecordingNoteKind::likely_milliseconds:
      return command ? "; --time-unit reads ms, us or ns" : "; time_unit reads ms, us or ns";
    default:
      return "";
  }
}

/// `columns a, b`, and the verb that agrees with it.
struct NamedColumns {
  std::string names;
  bool one = true;

  explicit NamedColumns(const std::vector<std::string>& columns) : one(columns.size() == 1) {
    std::vector<std::string> printed;
    for (const std::string& column : columns) printed.push_back(internal::printable(column));
    names = (one ? "column " : "columns ") + listed(printed);
  }

  std::string verb(const char* singular, const char* plural) const {
    return names + ' ' + (one ? singular : plural) + ' ';
  }
};

std::string text_of_unit(const RecordingNote& note) {
  return name(note.joint_unit.value_or(JointUnit::radians));
}

/// The part of a note on times.
std::string observation_of_times(const RecordingNote& note) {
  const NamedColumns columns(note.columns);
  if (note.kind == RecordingNoteKind::other_times) {
    return columns.verb("has", "have") + "other times of the samples and " +
           (columns.one ? "is" : "are") + " not read";
  }
  if (!note.time_unit)
    return columns.verb("has", "have") + "dates; times count from the first sample";
  return columns.verb("has", "have") + "times since 1970 in " + name(*note.time_unit) +
         (note.finer_unit ? " and " + name(*note.finer_unit) : "") +
         ", which count from the first sample";
}

/// The part of a note on units that names or comments give.
std::string observation_of_units(const RecordingNote& note) {
  const NamedColumns columns(note.columns);
  const std::string unit = text_of_unit(note), in_unit = "read in " + unit;
  switch (note.kind) {
    case RecordingNoteKind::named_unit:
      if (note.columns.empty()) {
        return "columns without a unit are " + in_unit + ", as a comment says";
      }
      return columns.verb("is", "are") + in_unit +
             (columns.one ? ", as its name says" : ", as their names say");
    case RecordingNoteKind::named_rate_unit:
      return columns.verb("is", "are") + in_unit + " per second, as a comment says";
    case RecordingNoteKind::no_unit:
      return columns.verb("is", "are") + in_unit +
             (columns.one ? ": its name gives no unit, " : ": their names give no unit, ") +
             "other names give one";
    default:
      break;
  }
  const std::string read = note.time_unit ? "times are read in " + name(*note.time_unit)
                                          : "columns without a unit are " + in_unit;
  return "the comment " + internal::in_quotes(note.comment) + " does not give a unit clearly; " +
         read;
}

/// The note without the path and without the choice that the user has.
std::string observation(const RecordingNote& note) {
  const std::string joint = "joint " + note.joint + " is at " + number(note.value);
  switch (note.kind) {
    case RecordingNoteKind::times_since_1970:
    case RecordingNoteKind::other_times:
      return ": " + observation_of_times(note);
    case RecordingNoteKind::no_header: {
      std::vector<std::string> columns;
      for (const std::string& column : note.columns) columns.push_back(internal::printable(column));
      return " has no header; its columns are read as " + listed(columns);
    }
    case RecordingNoteKind::index_column:
      return ": " + NamedColumns(note.columns).verb("numbers", "number") +
             "the rows, as the index of a table does, and is not read";
    case RecordingNoteKind::unread_rates:
      return ": " + NamedColumns(note.columns).verb("is", "are") +
             "not read: rates must be there for all joints and samples, and accelerations need "
             "velocities";
    case RecordingNoteKind::named_time_unit:
      return ": times are read in " + name(note.time_unit.value_or(TimeUnit::seconds)) +
             ", as a comment says";
    case RecordingNoteKind::named_unit:
    case RecordingNoteKind::named_rate_unit:
    case RecordingNoteKind::no_unit:
    case RecordingNoteKind::unclear_comment:
      return ": " + observation_of_units(note);
    case RecordingNoteKind::read_in_degrees:
      return " is read in degrees: " + joint + ", more than a revolution out of range in radians";
    case RecordingNoteKind::read_in_radians:
      return " is read in radians: neither the names of its columns nor its values say that its "
             "angles are in degrees";
    case RecordingNoteKind::likely_degrees:
      return ": " + joint + ", out of range in radians but not in degrees";
    case RecordingNoteKind::many_revolutions:
      return ": " + joint + " rad, more than two revolutions, but degrees of one";
    case RecordingNoteKind::likely_millimetres:
      return ": " + joint + " m, which is out of range but not in millimetres";
    case RecordingNoteKind::likely_milliseconds:
      break;
  }
  return ": the samples are " + number(note.value) +
         " s apart on average, and no joint reaches 0.2 % of its velocity limit";
}

}  // namespace

std::string name(JointUnit unit) { return joint_units.of(unit); }

std::string name(RecordingNoteKind kind) { return note_names.of(kind); }

JointUnit internal::joint_unit_of(const Unit& unit) { return joint_units.named(name_of(unit)); }

std::string sentence(const RecordingNote& note, OptionStyle style) {
  return note.path + observation(note) + choice_after(note, style);
}

}  // namespace beeline
