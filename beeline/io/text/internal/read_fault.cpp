#include <beeline/error.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/text_fault.h>
#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/internal/urdf_ignored.h>
#include <beeline/model/internal/axis_direction.h>

namespace beeline::internal {
namespace {

constexpr const char* run_xacro = "; run xacro first and pass the URDF that it writes";

/// Whether the value of an attribute is one that xacro should have computed.
bool is_macro(const ReadWarning& fault) {
  return fault.value.find("${") != std::string::npos || fault.value.find("$(") != std::string::npos;
}

/// What to do about the fault, after its fact; empty if the fact says it.
std::string cure(const ReadWarning& fault) {
  if (fault.kind == ReadWarningKind::xacro_tag) return run_xacro;
  if (fault.element_fault == ElementFault::not_utf8) return std::string(", ") + utf8_remedy;
  if (fault.element_fault == ElementFault::two_orientations) return "; write one of them";
  return is_macro(fault) ? "; run xacro first" : "";
}

/// Says that the fault's name is unknown, and which names are known unless they are listed before.
std::string unknown(const ReadWarning& fault, const std::string& what, const std::string& name,
                    const std::vector<std::string>& known) {
  return unknown_name(what, printable(name), known, fault.lists_known).what();
}

/// Says that an element or an attribute is unknown and ignored.
std::string ignored(const ReadWarning& fault, const std::string& what, const std::string& name) {
  const std::size_t more = fault.count;
  return unknown(fault, what, name, names_like(fault)) + "; it is ignored" +
         (more == 0
              ? ""
              : ", in " + std::to_string(more) + " more joint" + (more == 1 ? "" : "s") + " too");
}

/// The fact of text that is ignored or doubtful, or of a joint that is constant.
std::string ignored_fact(const ReadWarning& fault) {
  const std::string has = fault.joint.empty() ? "has " : "joint " + fault.joint + " has ";
  switch (fault.kind) {
    case ReadWarningKind::constant_mimic:
      return "joint " + fault.joint + " mimics joint " + printable(fault.value) +
             ", which is fixed: it is constant at " + number(fault.numbers[0]);
    case ReadWarningKind::zero_multiplier:
      return "joint " + fault.joint + " mimics joint " + printable(fault.value) +
             " with multiplier 0: it is constant at " + number(fault.numbers[0]);
    case ReadWarningKind::likely_degrees:
      return (fault.joint.empty() ? "" : "joint " + fault.joint + ": ") + "an angle of " +
             number(fault.numbers[0]) + " rad is more than a revolution; angles are in radians";
    case ReadWarningKind::unknown_element:
      return has + "an " + ignored(fault, "element", fault.element);
    case ReadWarningKind::unknown_attribute:
      return has + "an " + ignored(fault, "attribute of " + fault.element, fault.attribute);
    default:
      return has + std::to_string(fault.count) + " elements " + fault.element +
             "; the first one counts";
  }
}

/// The fact of what only MJCF has.
std::string mjcf_fact(const ReadWarning& fault) {
  switch (fault.kind) {
    case ReadWarningKind::nonlinear_coupling:
      return "joint " + fault.joint + " follows joint " + printable(fault.value) +
             " by a polycoef that is not linear; only its first two coefficients may differ from 0";
    case ReadWarningKind::range_ignored:
      return "joint " + fault.joint + " has the range " + number(fault.numbers[0]) + " to " +
             number(fault.numbers[1]) + ", which MuJoCo takes for none: it has no limits";
    default:
      return "the equality constraint " + fault.element +
             (fault.value.empty() ? "" : " " + in_quotes(fault.value)) +
             (fault.others.empty() ? "" : " of " + listed(fault.others)) +
             " is ignored: the arm moves as if it were not there";
  }
}

std::string malformed_clause(const ReadWarning& fault) {
  switch (fault.element_fault) {
    case ElementFault::none:
      break;
    case ElementFault::missing_attribute:
      return fault.element + " needs the attribute " + fault.attribute +
             (fault.value.empty() ? "" : "; it has " + fault.value);
    case ElementFault::missing_end:
      return "joint " + in_quotes(fault.joint) + " needs a " +
             fault.element.substr(0, fault.element.size() - 1) + " link=...>" +
             (fault.value.empty() ? "" : "; it has " + fault.value);
    case ElementFault::empty_name:
    case ElementFault::long_name:
    case ElementFault::control_character:
      return fault.element + ": " + fault.attribute + " " +
             clause(fault.element_fault, fault.value);
    case ElementFault::not_utf8:
      return fault.element + ": " + fault.attribute + " " + in_quotes(fault.value) +
             " is not UTF-8 text";
    case ElementFault::not_three_numbers:
      return fault.element + ": " + fault.attribute + " has " + std::to_string(fault.count) +
             " numbers; it must have three, as in \"0 0 1\"";
    case ElementFault::missing_number:
    case ElementFault::not_a_number:
    case ElementFault::out_of_range:
    case ElementFault::not_finite:
    case ElementFault::not_a_limit:
      return fault.element + ": " + fault.attribute + ": " +
             clause(fault.element_fault, fault.value);
    case ElementFault::not_four_numbers:
      return fault.element + ": " + fault.attribute + " has " + std::to_string(fault.count) +
             " numbers; it must have four, x y z w";
    case ElementFault::not_unit_length:
      return fault.element + ": the quaternion " + fault.attribute + " " + in_quotes(fault.value) +
             " does not have length 1";
    case ElementFault::two_orientations:
      return fault.element + ": has both rpy and " + fault.attribute;
  }
  return fault.element + " cannot be read";
}

}  // namespace

std::string clause(const ReadWarning& fault) { return fact(fault) + cure(fault); }

std::string fact(const ReadWarning& fault) {
  switch (fault.kind) {
    case ReadWarningKind::malformed:
      return malformed_clause(fault);
    case ReadWarningKind::xacro_tag:
      if (!fault.joint.empty()) return "joint " + fault.joint + " contains " + fault.element;
      return "is a xacro file (it contains " + fault.element + ")";
    case ReadWarningKind::unknown_link: {
      const std::string end = fault.element == "<parent>" ? "parent link" : "child link";
      return "joint " + fault.joint + " has an " + unknown(fault, end, fault.link, fault.others);
    }
    case ReadWarningKind::two_parents:
      return "link " + fault.link + " has two parents, by joints " + listed(fault.others) +
             " and " + fault.joint + "; a chain needs a tree";
    case ReadWarningKind::cycle:
      return "the links form a cycle through joint " + fault.joint + " and link " + fault.link +
             "; a chain needs a tree";
    case ReadWarningKind::repeated_name:
      return fault.joint.empty() ? "two links have the name " + fault.link
                                 : "two joints have the name " + fault.joint;
    case ReadWarningKind::unconnected_link:
      return "link " + fault.link + " is not connected by any joint";
    case ReadWarningKind::unknown_type:
      return "joint " + fault.joint + " has an " +
             unknown(fault, "type", fault.value, urdf_joint_types());
    case ReadWarningKind::zero_axis:
      return "joint " + fault.joint + ": " +
             no_direction({fault.numbers[0], fault.numbers[1], fault.numbers[2]});
    case ReadWarningKind::limits_reversed:
      return "joint " + fault.joint + ": lower limit " + number(fault.numbers[0]) +
             " exceeds upper limit " + number(fault.numbers[1]);
    case ReadWarningKind::rate_limit:
      return "joint " + fault.joint + ": " + fault.attribute + " limit " +
             number(fault.numbers[0]) + " is below " + number(Limits::min_rate) +
             "; 0 and -1 stand for none";
    case ReadWarningKind::unknown_leader:
      return "joint " + fault.joint + " mimics an " +
             unknown(fault, "joint", fault.value, fault.others);
    case ReadWarningKind::leader_cycle:
      return "joint " + fault.joint +
             (fault.value == fault.joint ? " mimics itself"
                                         : " follows leaders that mimic each other");
    case ReadWarningKind::nonlinear_coupling:
    case ReadWarningKind::range_ignored:
    case ReadWarningKind::constraint_ignored:
      return mjcf_fact(fault);
    case ReadWarningKind::constant_mimic:
    case ReadWarningKind::zero_multiplier:
    case ReadWarningKind::likely_degrees:
    case ReadWarningKind::unknown_element:
    case ReadWarningKind::unknown_attribute:
    case ReadWarningKind::repeated_element:
      return ignored_fact(fault);
    case ReadWarningKind::further_faults:
      return "has " + std::to_string(fault.count) + " more faults";
    default:
      throw Error(name(fault.kind) + " is no fault");
  }
}

}  // namespace beeline::internal
