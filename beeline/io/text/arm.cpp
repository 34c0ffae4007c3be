#include <algorithm>
#include <string_view>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/arm_format.h>
#include <beeline/io/text/internal/arm_to_json.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/urdf_shapes.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

namespace beeline {
namespace {

using internal::ArmFormat;
using internal::in_quotes;

Arm parse_json(std::string_view text, const std::string& path, const ChainEnds& /*ends*/,
               std::vector<ReadWarning>* warnings) {
  return arm_from_json(text, path, warnings);
}

/// Every format of arm files. A new reader is one row here: read_arm(), read_arm_shapes(), the
/// completion of the command and the errors follow.
constexpr ArmFormat arm_formats[] = {
    {"urdf", true, arm_from_urdf, internal::shapes_from_urdf},
    {"xml", true, arm_from_urdf, internal::shapes_from_urdf},  // URDF or MJCF, by the root element
    {"mjcf", true, arm_from_urdf, internal::shapes_from_urdf},
    {"xacro", true, arm_from_urdf, internal::shapes_from_urdf},
    {"json", false, parse_json, internal::shapes_from_arm_json},
};

void refuse_ends(const std::string& text, const ChainEnds& ends) {
  if (ends.base.empty() && ends.tip.empty()) return;
  throw Error("base and tip select a chain of a file that describes a tree of links (" +
              listed(internal::known_endings(true)) + "); " + in_quotes(text) + " is not one");
}

}  // namespace

std::vector<std::string> internal::known_endings(bool trees_only) {
  std::vector<std::string> endings;
  for (const ArmFormat& format : arm_formats) {
    if (format.tree || !trees_only) endings.push_back("." + std::string(format.ending));
  }
  return endings;
}

const ArmFormat* internal::arm_format_of(std::string_view path) {
  const std::string ending = extension(path);
  const auto* const format =
      std::find_if(std::begin(arm_formats), std::end(arm_formats),
                   [&](const ArmFormat& known) { return known.ending == ending; });
  return format == std::end(arm_formats) ? nullptr : format;
}

const ArmFormat& internal::arm_format_of_file(const std::string& path, const ChainEnds& ends) {
  const std::string ending = extension(path);
  if (ending == "srdf") {
    throw FileError(path, 0, "is an SRDF file, which has no kinematics; pass the URDF as the arm");
  }
  const ArmFormat* const format = arm_format_of(path);
  if (format == nullptr) {
    throw FileError(path, 0,
                    "is not a known kind of arm file; known are " + listed(known_endings()));
  }
  if (!format->tree) refuse_ends(path, ends);
  return *format;
}

namespace {

/// The built-in name that equals `text` up to the case of letters; empty if there is none. A joint
/// string such as RRR is not a name, although an arm is called rrr.
std::string built_in_name(const std::string& text) {
  const std::string lower = internal::lower_case(text);
  const std::vector<std::string> names = built_in_names();
  const bool known = std::find(names.begin(), names.end(), lower) != names.end();
  return known && (lower == text || !is_joint_string(text)) ? lower : "";
}

/// Refuses capitals that are mostly joint types: a joint string with an unknown letter.
void refuse_unknown_letters(const std::string& text) {
  constexpr std::string_view capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  if (text.find_first_not_of(capitals) != std::string::npos) return;
  const auto known = std::count_if(text.begin(), text.end(), [](char letter) {
    return is_joint_string(std::string_view(&letter, 1));
  });
  if (2 * static_cast<std::size_t>(known) <= text.size()) return;
  try {
    for (const char letter : text) composite_joint(letter, "joint");
  } catch (const Error& error) {
    throw Error("joint string " + internal::printable(text) + ": " + error.what());
  }
}

}  // namespace

std::string name(ReadWarningKind kind) {
  constexpr internal::EnumNames<ReadWarningKind> names("warning");
  return names.of(kind);
}

bool is_fault(const ReadWarning& warning) {
  return warning.kind != ReadWarningKind::tip_among_frames &&
         warning.kind != ReadWarningKind::tip_among_branches &&
         warning.kind != ReadWarningKind::before_gripper &&
         warning.kind != ReadWarningKind::below_free_joint;
}

std::string name(ElementFault fault) {
  constexpr internal::EnumNames<ElementFault> names("fault");
  return names.of(fault);
}

std::string internal::tip_option(const std::string& tip, OptionStyle style) {
  return style == OptionStyle::command ? "--tip " + shell_word(tip) : "tip=\"" + tip + "\"";
}

std::string internal::statement(const ReadWarning& warning, OptionStyle style) {
  const bool command = style == OptionStyle::command;
  const std::string dashes = command ? "--" : "";
  switch (warning.kind) {
    case ReadWarningKind::tip_among_frames:
      return "the tip is " + warning.link +
             "; other tips, fixed to the same link: " + listed(warning.others) + "; " + dashes +
             "tip selects another";
    case ReadWarningKind::tip_among_branches:
      return "the tip is " + warning.link + "; other tips: " + listed(warning.others) + "; " +
             dashes + "tip selects another";
    case ReadWarningKind::before_gripper:
      return "the tip is " + warning.link + ", before joint " + warning.joint +
             ", which moves a gripper; " + tip_option(listed(warning.others), style) +
             " includes it";
    case ReadWarningKind::below_free_joint:
      return "the base is " + warning.link + ", below joint " + warning.joint +
             ", which places the arm in the world; " + dashes + "base selects another";
    case ReadWarningKind::constant_mimic:
    case ReadWarningKind::zero_multiplier:
    case ReadWarningKind::unknown_element:
    case ReadWarningKind::unknown_attribute:
    case ReadWarningKind::repeated_element:
    case ReadWarningKind::range_ignored:
    case ReadWarningKind::constraint_ignored:
    case ReadWarningKind::likely_degrees:
    case ReadWarningKind::further_faults:
      return clause(warning);
    case ReadWarningKind::unknown_type:
    case ReadWarningKind::zero_axis:
    case ReadWarningKind::limits_reversed:
    case ReadWarningKind::rate_limit:
    case ReadWarningKind::unknown_leader:
    case ReadWarningKind::leader_cycle:
    case ReadWarningKind::nonlinear_coupling:
      return clause(warning) + "; the joint is beside the chain";
    case ReadWarningKind::xacro_tag:
      if (warning.joint.empty()) {
        return warning.element + " is left out; run xacro first if it stands for links or joints";
      }
      break;
    default:
      break;
  }
  return clause(warning) + "; it is beside the chain and left out";
}

std::string sentence(const ReadWarning& warning, OptionStyle style) {
  const std::string text = internal::statement(warning, style);
  if (!is_fault(warning)) return text;
  if (warning.program.empty() || warning.line == 0) {
    return FileError(warning.path, warning.line, text).what();
  }
  return FileError(warning.path, 0, internal::line_of_program(warning.line, warning.program) + text)
      .what();
}

std::vector<std::string> arm_file_endings() {
  std::vector<std::string> endings;
  for (const ArmFormat& format : arm_formats) endings.emplace_back(format.ending);
  return endings;
}

bool has_link_tree_ending(std::string_view path) {
  const ArmFormat* const format = internal::arm_format_of(path);
  return format != nullptr && format->tree;
}

Arm read_arm(const std::string& text, const ChainEnds& ends, std::vector<ReadWarning>* warnings) {
  const std::string name = built_in_name(text);
  if (!name.empty() || is_joint_string(text)) {
    refuse_ends(text, ends);
    return name.empty() ? arm_from_joint_string(text) : built_in(name);
  }
  if (text.find_first_of("./") != std::string::npos) {
    const ArmFormat& format = internal::arm_format_of_file(text, ends);
    return format.parse(read_file(text), text, ends, warnings);
  }
  refuse_unknown_letters(text);
  throw Error(std::string(unknown_name("arm", internal::printable(text), built_in_names()).what()) +
              "; or give a joint string such as RRR:3.5,3.5,2, or a file (" +
              listed(internal::known_endings()) + ")");
}

Arm arm_from_text(std::string_view text, const std::string& path, const ChainEnds& ends,
                  std::vector<ReadWarning>* warnings) {
  return internal::arm_format_of_file(path, ends).parse(text, path, ends, warnings);
}

}  // namespace beeline
