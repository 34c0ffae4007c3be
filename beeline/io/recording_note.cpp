#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/trajectory_file.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<RecordingNoteKind::likely_milliseconds> note_names(
    "note",
    "no_header times_since_1970 named_unit read_in_degrees read_in_radians likely_degrees "
    "many_revolutions likely_millimetres likely_milliseconds");

/// Returns the option that reads the recording otherwise, to be appended to the note.
const char* choice_after(RecordingNoteKind kind, OptionStyle style) {
  const bool command = style == OptionStyle::command;
  switch (kind) {
    case RecordingNoteKind::likely_degrees:
      return command ? "; --degrees reads degrees" : "; angle_unit=\"degrees\" reads degrees";
    case RecordingNoteKind::read_in_radians:
    case RecordingNoteKind::many_revolutions:
      return command ? "; --angle-unit deg reads degrees"
                     : "; angle_unit=\"degrees\" reads degrees";
    case RecordingNoteKind::likely_millimetres:
      return command ? "; the unit mm in a --joint-map file reads millimetres"
                     : "; the unit 0.001 in a joint_map reads millimetres";
    case RecordingNoteKind::likely_milliseconds:
      return command ? "; --time-unit reads ms, us or ns" : "; time_unit reads ms, us or ns";
    default:
      return "";
  }
}

/// `s`, or `s and ns` where a second column refines the first one.
std::string text_of_unit(const RecordingNote& note) {
  const std::string unit = name(note.time_unit.value_or(TimeUnit::seconds));
  if (note.columns.size() == 1) return unit;
  const auto columns = internal::time_columns(note.columns);
  const bool known = columns && columns->finer;
  return unit + " and " + (known ? name_of(*columns->finer_unit) : name(TimeUnit::nanoseconds));
}

/// The note without the choice that the user has.
std::string observation(const RecordingNote& note) {
  const std::string joint = "joint " + note.joint + " is at " + number(note.value);
  std::vector<std::string> columns;
  for (const std::string& column : note.columns) columns.push_back(internal::printable(column));
  const bool one = columns.size() == 1;
  switch (note.kind) {
    case RecordingNoteKind::no_header:
      return note.path + " has no header; its columns are read as " + listed(columns);
    case RecordingNoteKind::times_since_1970:
      if (!note.time_unit) {
        return note.path + ": column " + listed(columns) +
               " has dates; times count from the first sample";
      }
      return note.path + ": " + (one ? "column " : "columns ") + listed(columns) +
             (one ? " has" : " have") + " times since 1970 in " + text_of_unit(note) +
             ", which count from the first sample";
    case RecordingNoteKind::named_unit:
      if (columns.empty()) {
        return note.path + ": columns without a unit are read in " +
               name(note.joint_unit.value_or(JointUnit::radians)) + ", as a comment says";
      }
      return note.path + ": " + (one ? "column " : "columns ") + listed(columns) +
             (one ? " is" : " are") + " read in " +
             name(note.joint_unit.value_or(JointUnit::radians)) +
             (one ? ", as its name says" : ", as their names say");
    case RecordingNoteKind::read_in_degrees:
      return note.path + " is read in degrees: " + joint +
             ", more than a revolution out of range in radians";
    case RecordingNoteKind::read_in_radians:
      return note.path + " is read in radians: neither the names of its columns nor its values " +
             "say that its angles are in degrees";
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

}  // namespace

std::string name(JointUnit unit) {
  return name_of(internal::all_units()[static_cast<std::size_t>(unit)]);
}

std::string name(RecordingNoteKind kind) { return note_names.of(kind); }

std::string sentence(const RecordingNote& note, OptionStyle style) {
  return observation(note) + choice_after(note.kind, style);
}

}  // namespace beeline
