#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>

#include "arm_argument.h"
#include "format.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct FkArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string q;
  bool all = false;
};

std::string link_label(const Arm& arm, std::size_t i) {
  if (i == 0) return "base";
  const std::string& link = arm.joints()[i - 1].link;
  return link.empty() ? fmt::format("link{}", i) : link;
}

/// "T_2^1", the pose of link 2 in link 1, as in the chapter.
std::string transform_name(std::size_t to, const std::string& in) {
  return fmt::format("T_{}^{}", to, in);
}

/// The pose of every link in the one before and in the world, as matrices.
Answer all_links(const Arm& arm, const Configuration& q, bool in_plane, const UnitArgument& unit) {
  const std::vector<Pose> poses = link_poses(arm, q);
  in_plane = in_plane && is_at_height_zero(poses.back() * arm.tool()) &&
             std::all_of(poses.begin(), poses.end(), is_at_height_zero);
  const auto text = [&](const Pose& pose) { return pose_matrix_text(pose, in_plane, unit); };
  Answer answer;
  Json links = Json::list();
  const auto add = [&](const std::string& label, const Pose& in_world, const Pose* in_previous,
                       const std::string& name, const std::string& previous) {
    const std::string world = text(in_world);
    answer.text += label + "\n";
    answer.text += in_previous == nullptr
                       ? side_by_side({{"in the world", world}})
                       : side_by_side({{name + ", in " + previous, text(*in_previous)},
                                       {"in the world", world}});
  };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string label = link_label(arm, i);
    Json link = json_pose(poses[i], arm.planar(), unit);
    link.add("link", label);
    if (i == 0) {
      add(label, poses[i], nullptr, "", "");
    } else {
      const Pose in_previous = poses[i - 1].inverse() * poses[i];
      add(label, poses[i], &in_previous, transform_name(i, std::to_string(i - 1)),
          link_label(arm, i - 1));
      link.add("in_previous", json_pose(in_previous, arm.planar(), unit));
    }
    links.append(link);
  }
  const std::size_t n = poses.size() - 1;
  add("tool", poses[n] * arm.tool(), &arm.tool(), fmt::format("T_t^{}", n), link_label(arm, n));
  answer.document = {{"links", links}, {"tool_in_link", json_pose(arm.tool(), arm.planar(), unit)}};
  return answer;
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
  const bool in_plane = arguments.arm.shown_in_plane(arm);
  if (arguments.all) answer = all_links(arm, q, in_plane, unit);
  answer.text += "tool in the world\n" + pose_text(tool, in_plane, unit);
  answer.document.add("pose", json_pose(tool, arm.planar(), unit));
  return answer;
}

}  // namespace

Verb fk_verb() {
  const auto arguments = std::make_shared<FkArguments>();
  return {
      .name = "fk",
      .summary = "Forward kinematics: the pose of the tool, or of every link",
      .description =
          "Computes the pose of the tool in the world for given joint values (Dellaert, Serial "
          "Link Manipulators, eq. 1.1). For a planar arm it prints x and y in metres and the angle "
          "theta, with z unless that is 0; for others and for URDF files the position in metres, "
          "roll, pitch and yaw about the fixed axes X, Y, Z, and the unit quaternion; or the pose "
          "in --pose-form. Joint values outside the arm's limits give a warning.",
      .arguments = {arguments->arm.argument()},
      .options = joined({{configuration_option(&arguments->q)},
                         arguments->unit.options(),
                         {Option("--all",
                                 "Also print the homogeneous matrix of every link, from the base "
                                 "on: in the link before (T_1^0, T_2^1, ...) and in the world.",
                                 &arguments->all)},
                         arguments->arm.options()}),
      .examples =
          {{"The planar arm with three revolute joints, in degrees",
            "beeline fk rrr --q 112,-52,-60 --degrees"},
           {"The matrices of the worked example, link by link",
            "beeline fk rrr --q 112,-52,-60 --degrees --all"},
           {"All links of a Franka Panda, as JSON",
            "beeline fk panda --q 0,-0.785,0,-2.356,0,1.571,0.785 --all --json"},
           {"A gripper on a UR5 that stands on a table of 0.7 m",
            "beeline fk ur5 --q 0,-90,90,0,90,0 --degrees --tcp 0,0,0.15 --mount 0,0,0.7"},
           {"The pose as a KUKA shows it, in millimetres and degrees",
            "beeline fk kr6_r900 --q 0,-90,90,0,0,0 --degrees --pose-form abc --millimetres"},
           {"An arm given by its joint letters and link lengths",
            "beeline fk RRP:1,0.8,0 --q 0.5,0.2,0.3"}},
      .run = [arguments] { return fk(*arguments); }};
}

}  // namespace beeline::command
