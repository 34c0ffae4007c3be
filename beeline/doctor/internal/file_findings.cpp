#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/doctor/internal/findings.h>
#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_tree.h>
#include <beeline/io/text/internal/written_angles.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/urdf.h>

namespace beeline::internal {
namespace {

constexpr double one_turn = plausible_angle;

UrdfFile links_of_file(const std::string& path) {
  const std::string text = read_file(path);
  const ExpandedText expanded(text, path);
  return parse_link_tree(expanded.text(), path);
}

std::string in_line(int line) { return "line " + std::to_string(line); }

void find_in_rpy(const Vector3& rpy, int line, const std::string& place,
                 std::vector<Finding>& found) {
  if (!(rpy.cwiseAbs().maxCoeff() > one_turn)) return;
  found.push_back({.kind = FindingKind::angle_unit,
                   .place = place,
                   .what = "rpy " + number(rpy.x()) + " " + number(rpy.y()) + " " +
                           number(rpy.z()) + " rad (" + in_line(line) + "): degrees?",
                   .remedy = "write radians"});
}

void find_in_urdf(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  const UrdfFile file = links_of_file(path);
  constexpr std::size_t most_angles = 10;  // a file has many joints beside the chain
  std::size_t angles = 0;
  for (const UrdfFile::Joint& joint : file.joints) {
    if (joint.rpy.cwiseAbs().maxCoeff() > one_turn && ++angles <= most_angles) {
      find_in_rpy(joint.rpy, joint.line, "joint " + joint.name, found);
    }
    const auto place = std::find_if(arm.joints().begin(), arm.joints().end(),
                                    [&](const Joint& own) { return own.name == joint.name; });
    if (place == arm.joints().end()) continue;
    const auto index = static_cast<std::size_t>(place - arm.joints().begin());
    if (joint.axis_line == 0) {
      found.push_back({.kind = FindingKind::missing_axis,
                       .joint = static_cast<int>(index),
                       .place = joint_text(arm, index),
                       .what = "no <axis> (" + in_line(joint.line) + "): taken as 1 0 0",
                       .remedy = "write the axis, also where it is 1 0 0"});
    } else if (std::abs(joint.axis.norm() - 1) > 1e-3) {
      found.push_back({.kind = FindingKind::axis_length,
                       .joint = static_cast<int>(index),
                       .place = joint_text(arm, index),
                       .what = "axis of length " + number(joint.axis.norm()) + " (" +
                               in_line(joint.axis_line) + "), not 1",
                       .cost = "readers that do not normalise it scale the joint's motion",
                       .remedy = "write it with unit length"});
    }
  }
  if (angles <= most_angles) return;
  found.push_back({.kind = FindingKind::angle_unit,
                   .place = "file",
                   .what = "rpy beyond a revolution of " + std::to_string(angles - most_angles) +
                           " more joints: degrees?",
                   .remedy = "write radians"});
}

AngleUnit find_in_json(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  const JsonDocument document(read_file(path), path);
  for (const WrittenOrientation& each : written_orientations(document)) {
    find_in_rpy(each.rpy, each.line, each.joint.empty() ? each.key : "joint " + each.joint, found);
  }
  const AngleUnit unit = unit_of_dh(document);
  const bool declared = unit == AngleUnit::degrees;
  for (const WrittenDhAngle& each : written_dh_angles(document)) {
    if (std::abs(to_radians(each.angle, unit)) <= one_turn) continue;
    const double factor = std::numbers::pi / 180;
    found.push_back(
        {.kind = FindingKind::angle_unit,
         .joint = static_cast<int>(each.row),
         .place = joint_text(arm, each.row),
         .what = each.key + " " + number(each.angle) + (declared ? " deg (" : " rad (") +
                 in_line(each.line) + (declared ? "): converted to degrees twice?" : "): degrees?"),
         .remedy = (declared ? "in degrees: " : "in radians: ") + number(each.angle * factor)});
  }
  return unit;
}

std::string remedy_for(ElementFault fault) {
  switch (fault) {
    case ElementFault::not_utf8:
      return "save the file as UTF-8";
    case ElementFault::two_orientations:
      return "write one of them";
    case ElementFault::missing_attribute:
    case ElementFault::missing_end:
      return "write it";
    case ElementFault::empty_name:
    case ElementFault::long_name:
    case ElementFault::control_character:
      return "write another name";
    default:
      return "write the numbers, or delete the attribute";
  }
}

/// Returns the correction.
std::string remedy_for(const ReadWarning& warning) {
  switch (warning.kind) {
    case ReadWarningKind::xacro_tag:
      return "run xacro and pass the URDF that it writes";
    case ReadWarningKind::unknown_link:
    case ReadWarningKind::unconnected_link:
      return "connect it to a link of the file, or delete it";
    case ReadWarningKind::two_parents:
    case ReadWarningKind::cycle:
      return "delete one of the joints: a robot is a tree of links";
    case ReadWarningKind::repeated_name:
      return "give each its own name";
    case ReadWarningKind::unknown_type:
      return "write one of " + listed(urdf_joint_types());
    case ReadWarningKind::zero_axis:
      return "write the axis, such as 0 0 1";
    case ReadWarningKind::limits_reversed:
      return "exchange lower and upper limit";
    case ReadWarningKind::rate_limit:
      return "write the maker's limit, or 0 where it is unknown";
    case ReadWarningKind::unknown_leader:
      return "write the name of a joint of the file, or delete <mimic>";
    case ReadWarningKind::leader_cycle:
      return "delete <mimic> of the joint that leads the others";
    case ReadWarningKind::nonlinear_coupling:
      return "write a linear polycoef, or select a chain without the joint";
    case ReadWarningKind::range_ignored:
      return "write the lower limit first, or delete the range";
    case ReadWarningKind::constraint_ignored:
      return "select a chain that the constraint does not move, or couple joints by <joint>";
    case ReadWarningKind::constant_mimic:
      return "give the leader a type that moves, or make the joint fixed too";
    case ReadWarningKind::zero_multiplier:
      return "write the multiplier, or make the joint fixed";
    case ReadWarningKind::unknown_element:
    case ReadWarningKind::unknown_attribute:
      return "write a name of URDF, or delete it";
    case ReadWarningKind::repeated_element:
      return "delete the others";
    case ReadWarningKind::further_faults:
      return "mend those above first";
    default:
      return remedy_for(warning.element_fault);
  }
}

Finding finding_of(const ReadWarning& warning, const std::string& what) {
  return {.kind = FindingKind::fault,
          .place = warning.line > 0 ? in_line(warning.line) : "file",
          .what = what,
          .remedy = remedy_for(warning)};
}

/// Returns the faults of a URDF file and, if it has links, of its tree, in the order of its lines.
std::vector<UrdfFault> faults_by_line(const UrdfFile& file) {
  std::vector<UrdfFault> faults = file.links.empty() ? file.faults : UrdfTree(file).faults();
  std::stable_sort(faults.begin(), faults.end(), [](const UrdfFault& a, const UrdfFault& b) {
    return a.warning.line < b.warning.line;
  });
  return faults;
}

/// Appends the faults of the file: up to 100, and the number of the others. `text` writes one.
void append_faults(const std::string& path, std::string (*text)(const ReadWarning&),
                   std::vector<Finding>& found) {
  if (!has_link_tree_ending(path)) return;
  constexpr std::size_t most = 100;
  const UrdfFile file = links_of_file(path);
  const std::vector<UrdfFault> faults = faults_by_line(file);
  const std::vector<ReadWarning> listed = warnings_of(file, faults, most);
  for (const ReadWarning& warning : listed) found.push_back(finding_of(warning, text(warning)));
  const std::size_t further = faults.size() - listed.size() + file.further_faults;
  if (further == 0) return;
  found.push_back(
      finding_of({.kind = ReadWarningKind::further_faults, .path = path, .count = further},
                 "has " + std::to_string(further) + " more faults"));
}

}  // namespace

void find_faults(const std::string& path, std::vector<Finding>& found) {
  append_faults(
      path, [](const ReadWarning& warning) { return statement(warning, OptionStyle::keyword); },
      found);
}

AngleUnit find_in_file(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  if (extension(path) == "json") return find_in_json(path, arm, found);
  if (has_link_tree_ending(path)) find_in_urdf(path, arm, found);
  return AngleUnit::radians;
}

}  // namespace beeline::internal

namespace beeline {

std::vector<Finding> file_faults(const std::string& path) {
  std::vector<Finding> found;
  internal::append_faults(path, internal::fact, found);
  return found;
}

}  // namespace beeline
