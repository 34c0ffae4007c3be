#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/arm_tree.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/read_fault.h>
#include <beeline/io/text/urdf.h>

namespace beeline {
namespace {

const char* name_in_sentence(ArmFileFormat format) {
  return format == ArmFileFormat::mjcf ? "MJCF" : "URDF";
}

bool has_rates(const Limits& limits) {
  return std::isfinite(limits.velocity) || std::isfinite(limits.acceleration) ||
         std::isfinite(limits.jerk);
}

/// Returns ChainEnds::tip that the text needs. Without one the reader may end the chain before
/// joints with names of a gripper.
std::string needed_tip(const Arm& arm, const std::string& text, const std::string& last) {
  const Arm read = arm_from_urdf(text, "");
  return read.joints().size() == arm.joints().size() ? "" : last;
}

}  // namespace

std::string name(ArmFileFormat format) {
  constexpr internal::EnumNames<ArmFileFormat> names("format of arm files");
  return names.of(format);
}

ArmFileFormat arm_file_format(const std::string& path) {
  const std::string ending = extension(path);
  if (ending == "json") return ArmFileFormat::json;
  if (ending == "urdf") return ArmFileFormat::urdf;
  if (ending == "xml" || ending == "mjcf") return ArmFileFormat::mjcf;
  throw Error(path + ": an arm is written to a file .json, .urdf (ROS), .xml or .mjcf (MuJoCo)");
}

std::string name(ArmGapKind kind) {
  constexpr internal::EnumNames<ArmGapKind> names("gap");
  return names.of(kind);
}

std::string sentence(const ArmGap& gap, ArmFileFormat format) {
  const std::string in = name_in_sentence(format);
  switch (gap.kind) {
    case ArmGapKind::helical_joint:
      return gap.joint + " is helical; " + in + " has " +
             (format == ArmFileFormat::mjcf ? "hinge and slide" : "revolute and prismatic") +
             " joints";
    case ArmGapKind::equal_limits:
      return gap.joint + " has equal position limits, which MuJoCo takes for none";
    case ArmGapKind::repeated_link:
      return gap.joint + " moves a link " + gap.link + ", as another joint does; " + in +
             " needs a name for each link";
    case ArmGapKind::reserved_link:
      return gap.joint + " moves a link " + gap.link + ", which is the name of MuJoCo's fixed body";
    case ArmGapKind::too_many_joints:
      return "an arm of more than 90 joints has deeper nested bodies than readers of MJCF allow";
    case ArmGapKind::controller_frame:
      return gap.joint + " moves a link " + gap.link +
             ", which is the name of a frame of the controller that the arm has elsewhere";
  }
  return "";
}

ArmFile arm_file(const Arm& arm, ArmFileFormat format) {
  check_names(arm);
  if (format == ArmFileFormat::json) return {.text = arm_to_json(arm)};
  const internal::WrittenTree tree = internal::written_tree(arm, format);
  if (!tree.gaps.empty()) return {.gaps = tree.gaps};
  ArmFile file{.text = format == ArmFileFormat::urdf ? internal::urdf_text(arm, tree)
                                                     : internal::mjcf_text(arm, tree)};
  if (format == ArmFileFormat::mjcf) {
    for (const Joint& joint : arm.joints()) {
      if (has_rates(joint.limits)) file.without_rates.push_back(joint.name);
    }
  }
  file.tip = needed_tip(arm, file.text, tree.links.back().name);
  return file;
}

std::vector<std::string> file_notes(const ArmFile& file, const std::string& where,
                                    OptionStyle style) {
  std::vector<std::string> notes;
  if (!file.without_rates.empty()) {
    notes.push_back(where +
                    " has no limits of velocity, acceleration and jerk, as MJCF has none: " +
                    listed(file.without_rates));
  }
  if (!file.tip.empty()) {
    notes.push_back(where + " ends with the joints of a gripper; " +
                    internal::tip_option(file.tip, style) + " reads them too");
  }
  return notes;
}

void write_arm(const std::string& path, const Arm& arm) {
  const ArmFileFormat format = arm_file_format(path);
  const ArmFile file = arm_file(arm, format);
  if (!file) {
    std::string gaps;
    for (const ArmGap& gap : file.gaps) gaps += (gaps.empty() ? "" : "; ") + sentence(gap, format);
    throw Error(path + " is not written: " + gaps);
  }
  write_file(path, file.text);
}

}  // namespace beeline
