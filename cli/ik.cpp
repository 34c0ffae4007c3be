#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

#include "arm_argument.h"
#include "blocked_solutions.h"
#include "command/streams.h"
#include "format.h"
#include "inverse_argument.h"
#include "json_reason.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct IkArguments {
  ArmArgument arm;
  UnitArgument unit;
  std::string pose;
  InverseArgument inverse;
  SceneArgument scene;
};

/// The residual with the unit that follows from the status: metres, an angle, or the unit of the
/// joint outside its limits; without a unit if it is the larger of a distance and an angle.
struct Residual {
  double value = 0;
  std::string unit = {};
};

Residual residual_of(const UnitArgument& unit, const Arm& arm, const InverseResult& result) {
  switch (result.status) {
    case InverseStatus::unreachable:
      return {result.residual, " m"};
    case InverseStatus::orientation_unreachable:
      return {unit.shown(result.residual), fmt::format(" {}", unit.name())};
    case InverseStatus::outside_limits: {
      const int k = result.nearest->blocking;
      if (k < 0) break;  // the budget ended the search for the nearest configuration
      const bool prismatic = kind(arm.joint_of(k)) == JointKind::prismatic;
      return {unit.shown(arm, k, result.residual),
              fmt::format(" {}", prismatic ? "m" : unit.name())};
    }
    case InverseStatus::solved:
    case InverseStatus::not_found:
    case InverseStatus::time_limit:
    case InverseStatus::cancelled:
    case InverseStatus::work_limit:
    case InverseStatus::blocked:
      break;
  }
  return {result.residual};
}

bool has_position_limits(const Arm& arm) {
  return std::any_of(arm.limits().begin(), arm.limits().end(), [](const Limits& limits) {
    return std::isfinite(limits.lower) || std::isfinite(limits.upper);
  });
}

/// Which of the solutions that exist are given; empty if that is not known.
std::string completeness(const Arm& arm, const InverseResult& result, bool limited) {
  if (result.complete) return limited ? ", all that exist within the limits," : ", all that exist,";
  const bool only_turns_left = result.branches_complete && result.self_motion_dimension == 0;
  if (only_turns_left) return ", of joints without limits in the turn nearest to the seed,";
  if (!result.grid || result.solutions.size() + result.blocked.size() == 0) return {};
  return fmt::format(", all that exist at {} of {} of {},", result.grid->complete.size(),
                     counted(static_cast<std::int64_t>(result.grid->values.size()), "value"),
                     arm.joint_of(result.grid->joint).name);
}

/// InverseResult::deviation with angles in the unit of the output.
Eigen::VectorXd deviation_values(const Arm& arm, Eigen::VectorXd deviation,
                                 const UnitArgument& unit) {
  for (Eigen::Index k = arm.planar() ? 2 : 3; k < deviation.size(); ++k) {
    deviation[k] = unit.shown(deviation[k]);
  }
  return deviation;
}

/// The angle of the rotation in a deviation of x, y, z, roll, pitch, yaw, rad.
double rotation_of(const Eigen::VectorXd& deviation) {
  return so3_log(rotation(RollPitchYaw{deviation[3], deviation[4], deviation[5]})).norm();
}

std::string tool_deviation_text(const Arm& arm, const Eigen::VectorXd& deviation,
                                const UnitArgument& unit) {
  const std::string values = shown(deviation_values(arm, deviation, unit));
  if (arm.planar()) {
    return fmt::format("  deviation of the tool from the pose (x, y, theta): {}\n", values);
  }
  return fmt::format(
      "  deviation of the tool from the pose (x, y, z, roll, pitch, yaw): {}; its rotation {} {}\n",
      values, shown(unit.shown(rotation_of(deviation))), unit.name());
}

/// "8 solutions", or "infinitely many solutions (self-motion of dimension 1), 312 samples"; in a
/// scene "3 free solutions and 5 blocked".
std::string number_of_solutions(const InverseResult& result, bool in_scene) {
  const auto number_of = [&](const std::string& noun) {
    const auto count = static_cast<std::int64_t>(result.solutions.size());
    const std::size_t blocked = result.blocked.size();
    if (!in_scene || (count == 0 && blocked == 0)) return counted(count, noun);
    const std::string free = counted(count, "free " + noun);
    return blocked == 0 ? free : fmt::format("{} and {} blocked", free, blocked);
  };
  if (result.self_motion_dimension == 0) return number_of("solution");
  return fmt::format("infinitely many solutions (self-motion of dimension {}), {}{}",
                     result.self_motion_dimension, number_of("sample"),
                     result.branches_complete ? ", one of every branch," : "");
}

/// How to get the samples that a text does not list, or fewer solutions.
std::string about_samples(const Arm& arm, const InverseResult& result, std::size_t listed) {
  std::string text;
  if (listed < result.solutions.size()) {
    text = fmt::format("  and {} more, which --json prints\n", result.solutions.size() - listed);
  }
  if (arm.dof() == 1 || result.singular) return text;
  const std::string joint = result.grid ? arm.joint_of(result.grid->joint).name : "JOINT";
  return text + fmt::format(
                    "  --lock {}=VALUE gives {} at one value of a joint; without --all, "
                    "--redundancy nearest or centred gives the best one\n",
                    joint, result.self_motion_dimension == 1 ? "the finitely many" : "those");
}

/// A line for each solution; of infinitely many, for one of every branch, or the nearest to the
/// seed.
std::string solutions_text(const Arm& arm, const InverseResult& result, const UnitArgument& unit) {
  constexpr std::size_t max_samples = 10;
  const bool samples = result.self_motion_dimension > 0;
  const std::size_t count = samples && !result.branches_complete
                                ? std::min(max_samples, result.solutions.size())
                                : result.solutions.size();
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("  {}\n", shown(unit.shown(arm, result.solutions[i])));
  }
  return samples ? text + about_samples(arm, result, count) : text;
}

/// Two digits of a rounding error, six of the amount by which a pose is missed.
std::string residual_text(const InverseResult& result, const Residual& residual) {
  const bool error = result.status == InverseStatus::solved;
  return (error ? fmt::format("{:.2g}", residual.value) : shown(residual.value)) + residual.unit;
}

/// `limited`: whether solutions outside joint limits do not count.
std::string ik_text(const Arm& arm, const InverseResult& result, const CheckedScene* scene,
                    bool in_plane, bool limited, const UnitArgument& unit) {
  const bool solved = result.status == InverseStatus::solved;
  const Residual residual = residual_of(unit, arm, result);
  std::string text =
      fmt::format("{}: {}{} by {}, residual {}\n", name(result.status),
                  number_of_solutions(result, scene != nullptr), completeness(arm, result, limited),
                  result.method, residual_text(result, residual)) +
      solutions_text(arm, result, unit) + blocked_text(arm, result.blocked, unit);
  if (result.deviation) text += tool_deviation_text(arm, *result.deviation, unit);
  if (result.singular && solved) text += fmt::format("  {}\n", sentence(result.reason));
  if (result.nearest) {
    text += fmt::format("  nearest: q {}; tool at {}\n", shown(unit.shown(arm, result.nearest->q)),
                        shown(result.nearest->world_T_tool, in_plane, unit));
  }
  if (scene != nullptr) text += scene_text(*scene);
  return text;
}

Json grid_document(const Arm& arm, const SolutionGrid& grid, const UnitArgument& unit) {
  Json document{{"joint", arm.joint_of(grid.joint).name}};
  const auto values = [&](const std::vector<double>& all) {
    Json shown = Json::list();
    for (const double value : all) shown.append(unit.shown(arm, grid.joint, value));
    return shown;
  };
  document.add("values", values(grid.values));
  document.add("complete", values(grid.complete));
  return document;
}

Json nearest_document(const Arm& arm, const NearestMiss& nearest, const UnitArgument& unit) {
  Json document{{"q", unit.shown(arm, nearest.q)},
                {"pose", json_pose(nearest.world_T_tool, arm.planar(), unit)},
                {"position_error", nearest.error.position},
                {"orientation_error", unit.shown(nearest.error.orientation)}};
  if (nearest.blocking >= 0) {
    document.add("joint", arm.joint_of(nearest.blocking).name);
    document.add("excess", unit.shown(arm, nearest.blocking, nearest.excess));
  }
  return document;
}

Json ik_document(const Arm& arm, const InverseResult& result, const CheckedScene* scene,
                 const UnitArgument& unit) {
  Json solutions = Json::list();
  for (const Configuration& q : result.solutions) solutions.append(unit.shown(arm, q));
  Json nearest;
  if (result.nearest) nearest = nearest_document(arm, *result.nearest, unit);
  Json deviation, grid;
  if (result.deviation) deviation = deviation_values(arm, *result.deviation, unit);
  if (result.grid) grid = grid_document(arm, *result.grid, unit);
  Json document{{"status", name(result.status)},
                {"solutions", solutions},
                {"singular", result.singular},
                {"complete", result.complete},
                {"branches_complete", result.branches_complete},
                {"self_motion_dimension", result.self_motion_dimension},
                {"grid", grid},
                {"deviation", deviation},
                {"residual", residual_of(unit, arm, result).value},
                {"reason", sentence(result.reason)},
                {"nearest", nearest},
                {"method", result.method},
                {"iterations", result.iterations},
                {"restarts", result.restarts}};
  document.add(reason_members(result.reason));
  if (scene != nullptr) {
    document.add("blocked", json_blocked(arm, result.blocked, unit));
    document.add("scene", scene_document(*scene));
  }
  return document;
}

Answer ik(const IkArguments& arguments) {
  const Arm arm = arguments.arm.read(arguments.unit);
  const WrittenPose goal =
      in_world(arm, arguments.inverse.work.read(arm, arguments.unit),
               parse_pose_option(arm, "--pose", arguments.pose, arguments.unit));
  InverseOptions options = arguments.inverse.read(arm, arguments.arm, arguments.unit);
  options.budget = arguments.inverse.budget.next();
  for_option("--pose", [&] { check_pose_form(arm, goal, arguments.inverse.task); });
  const std::optional<CheckedScene> scene = arguments.scene.read(arguments.arm, arm);
  const CheckedScene* const in_scene = scene ? &*scene : nullptr;
  if (in_scene) {
    warn_if_unchecked(*in_scene);
    options.blocked_by = blocked_in(*in_scene);
  }
  warn_of_positions("--pose", arm, std::span(&goal.pose, 1), arguments.unit);
  InverseResult result = inverse_kinematics(arm, goal.pose, options);
  explain(result, arguments.inverse.budget.next());
  const bool solved = result.status == InverseStatus::solved;
  if (solved && result.residual > options.tolerance) {
    warn(fmt::format("rounding limits the error to {} m or rad for an arm of this size",
                     number(result.residual)));
  }
  const Residual residual = residual_of(arguments.unit, arm, result);
  return {
      .text = ik_text(arm, result, in_scene, arguments.arm.shown_in_plane(arm),
                      !options.ignore_limits && has_position_limits(arm), arguments.unit),
      .document = ik_document(arm, result, in_scene, arguments.unit),
      .units = {{"residual", residual.unit.empty() ? "m or rad" : residual.unit.substr(1)}},
      .yes = solved,
      .reason = sentence(result.reason) + (result.status == InverseStatus::blocked
                                               ? exemption_clause(*scene, result.blocked.front().q)
                                               : "")};
}

std::vector<Option> ik_options(IkArguments& arguments) {
  InverseArgument& inverse = arguments.inverse;
  return joined(
      {{Option("--pose POSE",
               "Pose of the tool in the world, or in --work: x,y,theta (planar arms), "
               "x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz; with --task position also "
               "x,y,z or, for planar arms, x,y.",
               &arguments.pose, {.required = true})},
       arguments.unit.options(),
       {Option("--all",
               "Print every solution found, the nearest to the seed first; of infinitely "
               "many, the nearest ten, all samples with --json.",
               &inverse.values.all),
        Option("--every-turn",
               "Print each solution with every multiple of 2 pi of its revolute joints "
               "within the position limits; of joints without limits, in the turn nearest to "
               "the seed.",
               &inverse.values.every_turn, {.needs = "--all"})},
       inverse.choice_options(),
       inverse.search_options(),
       arguments.scene.distance_options(),
       inverse.budget.options(),
       arguments.arm.options()});
}

}  // namespace

Verb ik_verb() {
  const auto arguments = std::make_shared<IkArguments>();
  return {
      .name = "ik",
      .summary = "Inverse kinematics: the joint values that reach a pose",
      .description =
          "Prints a status, then the solutions, one line of joint values each. The status is "
          "solved, unreachable (the position is out of reach), orientation_unreachable (the "
          "position can be reached, but not with this orientation), outside_limits (all "
          "solutions found violate position limits) or not_found (the search ended without a "
          "proof); or time_limit, work_limit or cancelled (by Ctrl-C) with the solutions found "
          "so far. With --scene or --self a solution is given only if each pair of bodies is "
          "proved to keep its clearance there, see `beeline help check`. The others are listed "
          "as blocked, with the two bodies that are closest; if there are no others, the "
          "status is blocked. Without --all the first free one is given; a redundant arm "
          "searches for it on the grid of its self-motion; solutions within --pose-tolerance are "
          "not searched where all exact ones are blocked. Without a solution, exit code 1 and "
          "the reason are given, and unless the status is blocked the nearest configuration. The "
          "residual is the error of the solutions, or the distance, the angle "
          "or the joint value by which the pose is missed.",
      .arguments = {arguments->arm.argument()},
      .options = ik_options(*arguments),
      .examples =
          {{"Both solutions of the planar arm",
            "beeline ik rrr --pose 4.459,5.226,0 --all --degrees"},
           {"A redundant arm: the solution most centred between its limits",
            "beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --redundancy centred"},
           {"A pose in the frame of a pallet, turned by 30 degrees",
            "beeline ik ur5 --pose 0.1,0.2,0.3,180,0,0 --work 0.3,0.1,0,0,0,30 --degrees"},
           {"A pose as a UR shows it: millimetres and a rotation vector",
            "beeline ik ur5 --pose=-300,-200,400,0,3.1416,0 --pose-form rotvec --millimetres"},
           {"All solutions with joint 7 at 45 degrees",
            "beeline ik panda --pose 0.4,0.1,0.5,180,0,0 --degrees --lock joint7=45 --all"},
           {"A pose that a UR5 reaches only on a rail, here of 3 m",
            "beeline ik ur5 --rail x:3 --pose 2.2,0.4,0.4,180,0,0 --degrees"},
           {"The solutions of an arm with shapes that keep 2 cm from a post and from itself",
            "printf '{\"name\": \"mine\", \"joint_string\": \"RRR:3.5,3.5,2\", \"shapes\": "
            "[{\"joint\": "
            "\"joint1\", \"shapes\": [{\"capsule\": {\"radius\": 0.1, \"length\": 3.5}, "
            "\"pose\": {\"xyz\": [-1.75, 0, 0], \"rpy\": [0, 1.5708, 0]}}]}]}' > arm.json\n"
            "printf '{\"obstacles\": [{\"name\": \"post\", \"shapes\": [{\"cylinder\": "
            "{\"radius\": 0.1, \"length\": 2}, \"pose\": {\"xyz\": [2.1, 1.3, 0]}}]}]}' > "
            "scene.json\n"
            "beeline ik arm.json --pose 4.459,5.226,0 --degrees --all --scene scene.json "
            "--clearance 0.02"},
           {"The numerical method for at most 10 ms, as JSON",
            "beeline ik ur5 --pose 0.4,0.2,0.3,3.14,0,0 --method numerical --time-limit 0.01 "
            "--json"}},
      .run = [arguments] { return ik(*arguments); }};
}

}  // namespace beeline::command
