#include <cmath>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/orientation.h>
#include <beeline/read/arm_json.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/urdf.h>
#include <beeline/trajectory/trajectory.h>

#include "arm_argument.h"
#include "format.h"
#include "result_files.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct ShowArguments {
  ArmArgument arm;
  LimitsArgument limits;
  UnitArgument unit;
  std::string out;
  bool json = false;
};

/// A limit of the position; an infinite one is none.
std::string position_limit(double limit, bool prismatic, const UnitArgument& unit) {
  if (!std::isfinite(limit)) return "none";
  return shown(prismatic ? limit : unit.shown(limit));
}

/// A limit of a derivative; one that is not known is assumed, and marked.
std::string rate_limit(double known, double kept, bool prismatic, const UnitArgument& unit) {
  return shown(prismatic ? kept : unit.shown(kept)) + (std::isfinite(known) ? "  " : " a");
}

constexpr double Limits::*rates[] = {&Limits::velocity, &Limits::acceleration, &Limits::jerk};
constexpr const char* rate_names[] = {"velocity", "acceleration", "jerk"};

/// The limits of joint i. Those of a joint that mimic joints follow are tightened so that these
/// stay within theirs.
const Limits& limits_of(const Arm& arm, std::size_t i) {
  const Joint& joint = arm.joints()[i];
  return joint.mimic ? joint.limits : arm.limits(arm.drives()[i].coordinate);
}

std::string joint_row(const Arm& arm, std::size_t i, const Pose& link, std::size_t width,
                      const UnitArgument& unit) {
  const Joint& joint = arm.joints()[i];
  const bool prismatic = kind(joint) == JointKind::prismatic;
  const Limits& limits = limits_of(arm, i);
  const Twist screw = adjoint(link, joint.screw);
  const Vector3 axis = prismatic ? screw.head<3>() : screw.tail<3>();
  std::string row = fmt::format("{:>3}  {:<{}}  {:<9}  {:<22}", i + 1, joint.name, width,
                                name(kind(joint)), shown(axis));
  for (const double limit : {limits.lower, limits.upper}) {
    row += fmt::format("  {:>9}", position_limit(limit, prismatic, unit));
  }
  const Limits kept = motion_limits(limits);
  for (const auto rate : rates) {
    row += fmt::format("  {:>12}", rate_limit(limits.*rate, kept.*rate, prismatic, unit));
  }
  row.erase(row.find_last_not_of(' ') + 1);
  if (kind(joint) == JointKind::helical) {
    row += fmt::format("  pitch {} m/rad", shown(pitch(joint)));
  }
  if (joint.mimic) {
    row += fmt::format("  = {} x {} + {}", shown(joint.mimic->multiplier), joint.mimic->leader,
                       shown(prismatic ? joint.mimic->offset : unit.shown(joint.mimic->offset)));
  }
  return row + "\n";
}

std::string joint_table(const Arm& arm, const UnitArgument& unit) {
  std::size_t width = 5;
  for (const Joint& joint : arm.joints()) width = std::max(width, joint.name.size());
  std::string table = fmt::format(
      "{:>3}  {:<{}}  {:<9}  {:<22}  {:>9}  {:>9}  {:>12}  {:>12}  {:>12}\n", "", "joint", width,
      "type", "axis in the world", "lower", "upper", "velocity  ", "acceleration", "jerk");
  bool assumed = false;
  const std::vector<Pose> links = link_poses(arm, Configuration::Zero(arm.dof()));
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    table += joint_row(arm, i, links[i + 1], width, unit);
    const Limits& limits = limits_of(arm, i);
    for (const auto rate : rates) assumed = assumed || !std::isfinite(limits.*rate);
  }
  if (assumed) table += "     (a: not known, assumed in motions; see --limits, --velocity)\n";
  return table + fmt::format(
                     "     (revolute joints in {}, prismatic joints in m; velocity per s, "
                     "acceleration per s^2, jerk per s^3)\n",
                     unit.name());
}

std::string frame_table(const Arm& arm, const UnitArgument& unit) {
  std::string table = fmt::format(
      "\nframes in the world, all joints at 0 (x y z in m; roll pitch yaw in {})\n", unit.name());
  const auto add = [&](const std::string& label, const Pose& pose) {
    const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
    const Eigen::Vector3d angles(unit.shown(rpy.roll), unit.shown(rpy.pitch), unit.shown(rpy.yaw));
    table += fmt::format("  {:<24}  {:<30}  {}\n", label, shown(pose.translation()), shown(angles));
  };
  const std::vector<Pose> links = link_poses(arm, Configuration::Zero(arm.dof()));
  for (std::size_t i = 0; i < links.size(); ++i) {
    add(i == 0 ? "0 (base)" : fmt::format("{} {}", i, arm.joints()[i - 1].link), links[i]);
  }
  add("tool", links.back() * arm.tool());
  return table;
}

std::string arm_text(const Arm& arm, const UnitArgument& unit) {
  const std::string text =
      fmt::format("{}: {}, {} degree{} of freedom, {}\n\n", arm.name(),
                  counted(static_cast<std::int64_t>(arm.joints().size()), "joint"), arm.dof(),
                  arm.dof() == 1 ? "" : "s", arm.planar() ? "planar" : "spatial") +
      joint_table(arm, unit) + frame_table(arm, unit);
  const Arm::Reach& reach = arm.reach();
  if (!std::isfinite(reach.radius)) {
    return text + "\nreach: unlimited, because a prismatic joint has no limits\n";
  }
  return text + fmt::format("\nreach: the tool stays within {} m of the point {}\n",
                            shown(reach.radius), shown(reach.centre));
}

Json joint_document(const Arm& arm, std::size_t i, const UnitArgument& unit) {
  const Joint& joint = arm.joints()[i];
  const bool prismatic = kind(joint) == JointKind::prismatic;
  const auto value = [&](double number) { return prismatic ? number : unit.shown(number); };
  const Limits& known = limits_of(arm, i);
  Json limits = Json::object();
  const auto add = [&](const char* key, double limit) {
    limits.add(key, value(limit));  // null where it is infinite
  };
  add("lower", known.lower);
  add("upper", known.upper);
  add("velocity", known.velocity);
  add("acceleration", known.acceleration);
  add("jerk", known.jerk);
  const Limits kept = motion_limits(known);
  Json assumed = Json::object();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(known.*rates[k])) assumed.add(rate_names[k], value(kept.*rates[k]));
  }
  Json document{{"name", joint.name}, {"type", name(kind(joint))}};
  if (!joint.link.empty()) document.add("link", joint.link);
  document.add("limits", limits);
  document.add("assumed", assumed);
  if (joint.mimic) {
    document.add("mimic", Json{{"joint", joint.mimic->leader},
                               {"multiplier", joint.mimic->multiplier},
                               {"offset", value(joint.mimic->offset)}});
  }
  return document;
}

Json arm_document(const Arm& arm, const UnitArgument& unit) {
  Json joints = Json::list();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    joints.append(joint_document(arm, i, unit));
  }
  return {{"name", arm.name()},
          {"joints", joints},
          {"dof", arm.dof()},
          {"planar", arm.planar()},
          {"reach",
           Json{{"centre", Eigen::VectorXd(arm.reach().centre)}, {"radius", arm.reach().radius}}}};
}

/// The chain of a group, or why it is none.
std::string chain_text(const Srdf& srdf, const std::string& group, const std::string& urdf) {
  try {
    const ChainEnds ends = group_ends(srdf, group, urdf);
    return fmt::format("{} to {}", ends.base, ends.tip);
  } catch (const Error&) {
    return "not one chain of this file";
  }
}

/// The state's values for the arm, or why it has none for it.
std::string state_text(const Srdf& srdf, const Srdf::State& state, const Arm& arm,
                       const UnitArgument& unit) {
  try {
    return shown(unit.shown(arm, named_state(srdf, arm, state.name, state.group)));
  } catch (const Error&) {
    return "not for this arm";
  }
}

/// Adds the groups and named states of --srdf.
void add_srdf(const ShowArguments& arguments, const Arm& arm, Answer& answer) {
  const Srdf srdf = read_srdf(arguments.arm.srdf);
  Json groups = Json::list(), states = Json::list();
  answer.text += fmt::format("\ngroups of {}\n", srdf.path);
  for (const Srdf::Group& group : srdf.groups) {
    const std::string chain = chain_text(srdf, group.name, arguments.arm.text);
    answer.text += fmt::format("  {:<24}  {}\n", group.name, chain);
    groups.append({{"name", group.name}, {"chain", chain}});
  }
  answer.text += fmt::format("\nnamed states (joint values in {}, m)\n", arguments.unit.name());
  for (const Srdf::State& state : srdf.states) {
    const std::string values = state_text(srdf, state, arm, arguments.unit);
    answer.text += fmt::format("  {:<24}  {:<16}  {}\n", state.name, state.group, values);
    Json joints = Json::object();
    for (const auto& [joint, numbers] : state.joints) {
      joints.add(joint, Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                            numbers.data(), static_cast<Eigen::Index>(numbers.size()))));
    }
    states.append({{"name", state.name}, {"group", state.group}, {"joints", joints}});
  }
  answer.document.add("groups", groups);
  answer.document.add("states", states);
}

Answer show(const ShowArguments& arguments) {
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  if (!arguments.out.empty()) {
    if (internal::extension(arguments.out) != "json") {
      throw Error("--out " + arguments.out + ": an arm is written to a .json file");
    }
    refuse_overwriting(arguments.out,
                       {arguments.arm.text, arguments.arm.srdf, arguments.arm.limits});
    internal::write_file(arguments.out, arm_to_json(arm));
  }
  Answer answer{.text = arm_text(arm, arguments.unit),
                .document = arm_document(arm, arguments.unit)};
  if (!arguments.arm.srdf.empty()) add_srdf(arguments, arm, answer);
  return answer;
}

}  // namespace

Verb show_verb() {
  static ShowArguments arguments;
  return {
      .name = "show",
      .summary = "Print an arm as a table: joints, limits, frames, reach",
      .description =
          "Prints each joint with its type, its axis in the world at zero joint values, its "
          "position limits (lower, upper) and its limits of velocity, acceleration and jerk; "
          "the frames of all links and of the tool at zero joint values; and a ball that the "
          "tool cannot leave. Limits that are not known are assumed in motions; they are marked "
          "with an a, and with --json null, with the assumed ones in `assumed`. With --srdf also "
          "its groups and named states.",
      .arguments = {arguments.arm.argument()},
      .options = joined({arguments.unit.options(),
                         {{.name = "--out",
                           .value = "FILE",
                           .help = "Also write the arm to this .json file.",
                           .target = &arguments.out,
                           .completes = Completes::file}},
                         arguments.arm.options(),
                         arguments.limits.options()}),
      .examples = {{"The Franka Panda, angles in degrees", "beeline show panda --degrees"},
                   {"A UR5 with limits of its user",
                    "beeline show ur5 --velocity 3.14 --acceleration 15 --speed 0.5"},
                   {"An arm file to change and use in place of the built-in arm",
                    "beeline show ur5 --out my_arm.json\nbeeline show my_arm.json"}},
      .json = &arguments.json,
      .run = [] { return show(arguments); }};
}
