#include "arm_argument.h"

#include <algorithm>
#include <cctype>
#include <tuple>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/urdf.h>

#include "command/streams.h"
#include "pose_argument.h"

namespace beeline::command {
namespace {

/// Whether a text typed for joint values can be a name only: it begins with a letter and is not a
/// list.
bool is_name(const std::string& text) {
  return std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         text.find(',') == std::string::npos;
}

/// The chapter names two arms by joint strings that mean planar arms with links of 1 m here.
void hint_at_built_in(const std::string& text) {
  for (const auto& [joints, name, what] :
       {std::tuple{"RRRRRR", "puma560", "Puma"}, std::tuple{"RRRP", "scara", "SCARA"}}) {
    if (text != joints) continue;
    warn(text + " without lengths is a planar arm with links of 1 m; the chapter's " + what +
         " is the built-in arm " + name);
  }
}

}  // namespace

Positional ArmArgument::argument() {
  return {.name = "ARM",
          .help =
              "A built-in arm, a joint string or a file (.urdf, .xacro, MuJoCo's .xml, .json). "
              "NAME:=VALUE gives an argument of a .xacro file its value.",
          .target = &text,
          .completes = Completes::arm};
}

std::vector<std::string> ArmArgument::inputs(std::vector<std::string> others) const {
  others.insert(others.end(), {text, srdf, limits});
  return others;
}

std::vector<Option> ArmArgument::options() {
  return joined(
      {chain_options(),
       {Option("--tcp POSE",
               "The tool centre point: its pose in the arm's own tool frame, as --mount.", &tcp),
        Option("--mount POSE",
               "Where the arm stands: the pose of its base in the world, as x,y,theta (planar "
               "arms), x,y,z (other arms), x,y,z,roll,pitch,yaw, x,y,z,qw,qx,qy,qz or another "
               "--pose-form.",
               &mount)},
       moving_base.options(),
       {Option("--limits FILE",
               "Joint limits that replace the arm's: MoveIt's joint_limits.yaml, or .json with "
               "{JOINT: {lower, upper, velocity, acceleration, jerk}, ...}, each optional.",
               &limits)}});
}

std::vector<Option> ArmArgument::chain_options() {
  return {
      Option("--base LINK",
             "First link of the chain, any link of a URDF file or body of MJCF. Default: its root "
             "link, or the "
             "link below a floating or planar joint.",
             &base),
      Option("--tip LINK",
             "Last link of the chain, any link of a URDF file, body or site of MJCF. Default: the "
             "leaf that a joint "
             "moves, of several tool0 or, if only fixed joints are between them, the first; before "
             "the joints of a gripper.",
             &tip),
      Option(
          "--srdf FILE",
          "MoveIt's SRDF file of the arm: its groups for --group, its named states wherever joint "
          "values are typed, such as --from home, and, with --scene or --self, the pairs of "
          "links that it exempts by disable_collisions and the values of joints beside the chain.",
          &srdf),
      Option("--group NAME",
             "The group of --srdf that gives base and tip of the chain; --base and --tip replace "
             "them.",
             &group, {.needs = "--srdf"})};
}

ChainEnds ArmArgument::ends() const {
  ChainEnds ends;
  if (!srdf.empty()) {
    const Srdf semantics = read_srdf(srdf);  // refused also where no name of it is used
    if (!group.empty()) ends = group_ends(semantics, group, text);
  }
  if (!base.empty()) ends.base = base;
  if (!tip.empty()) ends.tip = tip;
  return ends;
}

ArmShapes ArmArgument::shapes(ShapeOptions options) const {
  options.srdf = srdf;
  ArmShapes read = read_arm_shapes(text, ends(), options);
  if (!read.links_with_planes.empty()) {
    warn(planes_note(text, read.links_with_planes));
  }
  read.links = behind_joints(std::move(read.links), moving_base.joints(), read.standing);
  return read;
}

LinkShapes ArmArgument::tool_shapes(const std::string& path) const {
  LinkShapes tool = read_tool_shapes(path, read_arm(text, ends()));
  tool.link += moving_base.joints();
  return tool;
}

Arm ArmArgument::read(const UnitArgument& unit, bool reports_faults) const {
  std::vector<ReadWarning> warnings;
  const Arm described = read_arm(text, ends(), &warnings);
  for (const ReadWarning& warning : warnings) {
    if (reports_faults || !is_fault(warning)) warn(sentence(warning, OptionStyle::command));
  }
  hint_at_built_in(text);
  Arm arm = described;
  if (!tcp.empty()) {
    const Pose tool_T_tcp = parse_frame_option(described, "--tcp", tcp, unit).pose;
    warn_of_distance("--tcp", offset_in_millimetres(described, tool_T_tcp), unit);
    const double length = tool_T_tcp.translation().norm();
    if (unit.millimetres && length > 0 && length < 1e-3) {
      warn("--tcp moves the tool by " + number(length * 1000) +
           " mm; with --millimetres its position is in millimetres, like all others");
    }
    arm = with_tcp(arm, tool_T_tcp);
  }
  if (!mount.empty()) {
    const Pose world_T_base = parse_frame_option(described, "--mount", mount, unit).pose;
    arm = with_mount(arm, world_T_base);
    warn_of_distance("--mount", mount_in_millimetres(world_T_base), unit);
  }
  arm = moving_base.on(arm, unit);
  if (limits.empty()) return arm;
  const JointLimits file = read_joint_limits(limits, arm);
  for (const std::string& note : file.notes) warn(note);
  return with_limits(arm, file.joints);
}

bool ArmArgument::shown_in_plane(const Arm& arm) const {
  return arm.planar() && !has_link_tree_ending(text);
}

Configuration ArmArgument::state(const Srdf& srdf_file, const Arm& arm, const std::string& name,
                                 const std::string& of_group) const {
  if (!moving_base.given()) return named_state(srdf_file, arm, name, of_group);
  const Arm alone = read_arm(text, ends());
  return moving_base.at_zero(arm, named_state(srdf_file, alone, name, of_group));
}

Configuration ArmArgument::configuration(const Arm& arm, const std::string& values,
                                         const std::string& option,
                                         const UnitArgument& unit) const {
  if (srdf.empty() && is_name(values)) {
    throw Error(option + ": " + "\"" + values +
                "\" is not a list of numbers; named states need --srdf FILE");
  }
  if (srdf.empty()) return unit.configuration(arm, values, option);
  const Srdf semantics = read_srdf(srdf);
  const bool known = std::any_of(semantics.states.begin(), semantics.states.end(),
                                 [&](const Srdf::State& each) { return each.name == values; });
  return known || is_name(values) ? state(semantics, arm, values, group)
                                  : unit.configuration(arm, values, option);
}

}  // namespace beeline::command
