#include <fmt/core.h>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

#include "arm_argument.h"
#include "format.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct FkArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string q;
  bool all = false, json = false;
};

std::string link_label(const Arm& arm, std::size_t i) {
  if (i == 0) return "base";
  const std::string& link = arm.joints()[i - 1].link;
  return link.empty() ? fmt::format("link{}", i) : link;
}

Answer fk(const FkArguments& arguments) {
  const UnitArgument& unit = arguments.unit;
  const Arm arm = arguments.arm.read(arguments.unit);
  const Configuration q = arguments.arm.configuration(arm, arguments.q, "--q", unit);
  warn_outside_limits(arm, q);
  const Pose tool = forward_kinematics(arm, q);
  if (!tool.matrix().allFinite()) {
    throw Error("--q: the tool's position exceeds the range of numbers, 1e308 m");
  }
  Answer answer;
  Json links = Json::list();
  const std::vector<Pose> poses = arguments.all ? link_poses(arm, q) : std::vector<Pose>{};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string label = link_label(arm, i);
    answer.text += label + " in the world\n" + pose_text(poses[i], arm.planar(), unit);
    Json link = json_pose(poses[i], arm.planar(), unit);
    link.add("link", label);
    links.append(link);
  }
  answer.text += "tool in the world\n" + pose_text(tool, arm.planar(), unit);
  answer.document = {{"pose", json_pose(tool, arm.planar(), unit)}};
  if (arguments.all) answer.document.add("links", links);
  return answer;
}

}  // namespace

Verb fk_verb() {
  static FkArguments arguments;
  Option q = joint_values_option(
      "--q", "Joint values, comma-separated, from the base on; metres for a prismatic joint.",
      &arguments.q);
  q.required = true;
  return {
      .name = "fk",
      .summary = "Forward kinematics: the pose of the tool, or of every link",
      .description =
          "Computes the pose of the tool in the world for given joint values (Dellaert, Serial "
          "Link Manipulators, eq. 1.1). For a planar arm it prints x and y in metres and the angle "
          "theta; otherwise the position in metres, roll, pitch and yaw about the fixed axes "
          "X, Y, Z, and the unit quaternion. Joint values outside the arm's limits give a "
          "warning.",
      .arguments = {arguments.arm.argument()},
      .options = joined({{q},
                         arguments.unit.options(),
                         {{.name = "--all",
                           .help = "Also print the pose of every link, from the base on.",
                           .target = &arguments.all}},
                         arguments.arm.options()}),
      .examples = {{"The planar arm with three revolute joints, in degrees",
                    "beeline fk rrr --q 112,-52,-60 --degrees"},
                   {"All links of a Franka Panda, as JSON",
                    "beeline fk panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --all --json"},
                   {"A gripper on a UR5 that stands on a table of 0.7 m",
                    "beeline fk ur5 --q 0,-90,90,0,90,0 --degrees --tcp 0,0,0.15 --mount 0,0,0.7"},
                   {"An arm given by its joint letters and link lengths",
                    "beeline fk RRP:1,0.8,0 --q 0.5,0.2,0.3"}},
      .json = &arguments.json,
      .run = [] { return fk(arguments); }};
}
