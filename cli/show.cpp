#include <cmath>
#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/orientation.h>
#include <beeline/read/arm_json.h>
#include <beeline/read/file.h>

#include "results.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string out;
  bool json = false;
};

std::string limit_text(double limit, bool angle, const UnitArgument& unit) {
  if (!std::isfinite(limit)) return "-";
  return shown(angle ? unit.shown(limit) : limit);
}

/// A leading joint's limits, narrowed so that its followers keep theirs.
const Limits& limits_in_arm(const Arm& arm, std::size_t joint) {
  return arm.limits(arm.drives()[joint].coordinate);
}

void print_joints(const Arm& arm, const UnitArgument& unit) {
  std::size_t width = 5;
  for (const Joint& joint : arm.joints()) width = std::max(width, joint.name.size());
  fmt::print("{:>3}  {:<{}}  {:<9}  {:<22}  {:>9}  {:>9}  {:>9}\n", "", "joint", width, "type",
             "axis in the world", "lower", "upper", "velocity");
  const std::vector<Pose> links = link_poses(arm, Configuration::Zero(arm.dof()));
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const bool slides = kind(joint) == JointKind::prismatic;
    const Limits& limits = joint.mimic ? joint.limits : limits_in_arm(arm, i);
    const Twist screw = adjoint(links[i + 1], joint.screw);
    const Vector3 axis = slides ? screw.head<3>() : screw.tail<3>();
    fmt::print("{:>3}  {:<{}}  {:<9}  {:<22}  {:>9}  {:>9}  {:>9}", i + 1, joint.name, width,
               name(kind(joint)), shown(axis), limit_text(limits.lower, !slides, unit),
               limit_text(limits.upper, !slides, unit), limit_text(limits.velocity, !slides, unit));
    if (kind(joint) == JointKind::helical) fmt::print("  pitch {} m/rad", shown(pitch(joint)));
    if (joint.mimic) {
      fmt::print("  = {} x {} + {}", shown(joint.mimic->multiplier), joint.mimic->leader,
                 shown(slides ? joint.mimic->offset : unit.shown(joint.mimic->offset)));
    }
    fmt::print("\n");
  }
}

void print_frames(const Arm& arm, const UnitArgument& unit) {
  fmt::print("\nframes in the world, all joints at 0 (x y z in m; roll pitch yaw in {})\n",
             unit.name());
  const auto print_frame = [&unit](const std::string& label, const Pose& pose) {
    const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
    const Eigen::Vector3d angles(unit.shown(rpy.roll), unit.shown(rpy.pitch), unit.shown(rpy.yaw));
    fmt::print("  {:<24}  {:<30}  {}\n", label, shown(pose.translation()), shown(angles));
  };
  const std::vector<Pose> links = link_poses(arm, Configuration::Zero(arm.dof()));
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::string link = i == 0 ? "" : arm.joints()[i - 1].link;
    print_frame(i == 0 ? "0 (base)" : fmt::format("{} {}", i, link), links[i]);
  }
  print_frame("tool", links.back() * arm.tool());
}

void print_table(const Arm& arm, const UnitArgument& unit) {
  fmt::print("{}: {} joint{}, {} degree{} of freedom, {}\n\n", arm.name(), arm.joints().size(),
             arm.joints().size() == 1 ? "" : "s", arm.dof(), arm.dof() == 1 ? "" : "s",
             arm.planar() ? "planar" : "spatial");
  print_joints(arm, unit);
  fmt::print("     (angles in {}, slides in m, velocities per second, - is no limit)\n",
             unit.name());
  print_frames(arm, unit);
  const Arm::Reach& reach = arm.reach();
  if (std::isfinite(reach.radius)) {
    fmt::print("\nreach: the tool never leaves the ball of radius {} m around {}\n",
               shown(reach.radius), shown(reach.centre));
  } else {
    fmt::print("\nreach: unlimited, for a joint that slides has no limits\n");
  }
}

OrderedJson document(const Arm& arm, const UnitArgument& unit) {
  OrderedJson joints = OrderedJson::array();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const bool slides = kind(joint) == JointKind::prismatic;
    const Limits& known = joint.mimic ? joint.limits : limits_in_arm(arm, i);
    OrderedJson limits;
    const auto add = [&](const char* key, double value) {
      if (std::isfinite(value)) limits[key] = slides ? value : unit.shown(value);
    };
    add("lower", known.lower);
    add("upper", known.upper);
    add("velocity", known.velocity);
    add("acceleration", known.acceleration);
    add("jerk", known.jerk);
    OrderedJson entry{{"name", joint.name}, {"type", name(kind(joint))}};
    if (!joint.link.empty()) entry["link"] = joint.link;
    entry["limits"] = limits.is_null() ? OrderedJson::object() : limits;
    if (joint.mimic) {
      entry["mimic"] = {{"joint", joint.mimic->leader},
                        {"multiplier", joint.mimic->multiplier},
                        {"offset", slides ? joint.mimic->offset : unit.shown(joint.mimic->offset)}};
    }
    joints.push_back(entry);
  }
  return {
      {"name", arm.name()},
      {"joints", joints},
      {"dof", arm.dof()},
      {"planar", arm.planar()},
      {"reach",
       {{"centre", json_vector(arm.reach().centre)}, {"radius", json_number(arm.reach().radius)}}}};
}

Exit show(const Arguments& arguments) {
  const Arm arm = arguments.arm.read();
  if (!arguments.out.empty() && extension(arguments.out) != "json") {
    throw Error("--out " + arguments.out + ": arms are written as .json files");
  }
  refuse_overwriting(arguments.out, {arguments.arm.text});
  if (!arguments.out.empty()) write_file(arguments.out, arm_to_json(arm));
  if (arguments.json) {
    print_json(document(arm, arguments.unit));
  } else {
    print_table(arm, arguments.unit);
  }
  return Exit::yes;
}

}  // namespace

Run declare_show(CLI::App& verb) {
  static Arguments arguments;
  arguments.arm.declare(verb);
  arguments.unit.declare(verb);
  verb.add_option("--out", arguments.out, "Also write the arm to this JSON file");
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer(
      "Examples:\n"
      "  beeline show panda --degrees\n"
      "  beeline show robot.urdf --tip tool0 --out robot.json");
  return [] { return show(arguments); };
}
