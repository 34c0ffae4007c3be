#include <algorithm>
#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/model/moving_base.h>
#include <beeline/reach/place.h>

#include "arm_argument.h"
#include "blocked_solutions.h"
#include "budget_argument.h"
#include "command/progress.h"
#include "format.h"
#include "json_reason.h"
#include "pose_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct PlaceArguments {
  std::string map, poses, lower, upper;
  ArmArgument shaped;  ///< --arm with the options of its chain
  SceneArgument scene;
  UnitArgument unit;
  BudgetArgument budget;
  PlacementOptions options;
};

Answer answer_of(const Arm& arm, const PlacementResult& result, const PlaceArguments& arguments) {
  const UnitArgument& unit = arguments.unit;
  const bool complete = result.ending == Ending::complete;
  const Reason reason = reason_of(result);
  Answer answer{.yes = !reason, .reason = sentence(reason)};
  answer.text = fmt::format("{} checked of {}; all poses reached from {}\n",
                            counted(result.checked, "mount"), result.mounts, result.reaching);
  if (result.blocked > 0) {
    answer.text += fmt::format("{} left out: blocked in the scene\n  the first: {}\n",
                               result.blocked, sentence(result.blocked_reason));
  }
  if (result.without_lines > 0) {
    answer.text += fmt::format("{} left out: not in straight lines", result.without_lines);
    if (result.blocked_lines > 0) {
      answer.text += fmt::format(", {} of them because of the scene", result.blocked_lines);
    }
    answer.text += "\n";
  }
  Json list = Json::list();
  if (result) {
    answer.text += fmt::format("\n{:<40} {:>9} {:>14}{}\n", "--mount", "margin", "manipulability",
                               arguments.options.lines ? "   lines, s" : "");
  }
  for (const Placement& placement : result.placements) {
    const std::string mount = typed(placement.world_T_mount, arm.planar(), unit);
    answer.text +=
        fmt::format("{:<40} {:>9.4f} {:>14.5g}", mount, placement.margin, placement.manipulability);
    if (arguments.options.lines) answer.text += fmt::format("{:>11.2f}", placement.duration);
    answer.text += "\n";
    Json json{{"mount", mount},
              {"pose", json_pose(placement.world_T_mount, false, unit)},
              {"heading", unit.shown(placement.heading)},
              {"margin", placement.margin},
              {"manipulability", placement.manipulability}};
    if (arguments.options.lines) json.add("duration", placement.duration);
    Json solutions = Json::list();
    for (const Configuration& q : placement.solutions) solutions.append(Json(unit.shown(arm, q)));
    json.add("solutions", solutions);
    list.append(json);
  }
  answer.document = {{"status", !complete ? name(result.ending)
                                : result  ? "found"
                                          : "not_found"},
                     {"mounts", result.mounts},
                     {"checked", result.checked},
                     {"reaching", result.reaching},
                     {"blocked", result.blocked},
                     {"without_lines", result.without_lines},
                     {"blocked_lines", result.blocked_lines},
                     {"placements", list}};
  answer.document.add(json_reason(reason));
  return answer;
}

/// Throws Error unless the arm of --arm has the joints of the map's arm.
void check_same_joints(const Arm& shaped, const Arm& arm) {
  constexpr double rounding = 1e-12;
  const auto is_same = [](const Joint& a, const Joint& b) {
    return (a.offset.matrix() - b.offset.matrix()).cwiseAbs().maxCoeff() < rounding &&
           (a.screw - b.screw).cwiseAbs().maxCoeff() < rounding;
  };
  const bool same = std::equal(shaped.joints().begin(), shaped.joints().end(), arm.joints().begin(),
                               arm.joints().end(), is_same);
  if (!same) throw Error("--arm: " + shaped.name() + " has other joints than the map's arm");
}

/// The scene in the world, and the map's arm with the shapes of --arm.
std::optional<CheckedScene> scene_of(const PlaceArguments& arguments, const Arm& arm) {
  if (arguments.scene.given() == arguments.shaped.text.empty()) {
    throw Error(
        "--arm and --scene or --self: a map has no shapes of its arm's links, so that a scene "
        "needs both");
  }
  if (arguments.scene.given()) {
    check_same_joints(arguments.shaped.read(arguments.unit, false), arm);
  }
  return arguments.scene.read(arguments.shaped, arm);
}

Vector3 corner_of(const std::string& text, const char* option) {
  const WrittenPose written = parse_pose(text, {.triple = Triple::position});
  if (written.oriented || written.planar) throw Error(std::string(option) + ": a corner is x,y,z");
  return written.pose.translation();
}

/// Refuses an arm of --rail or --mobile-base: a mount of the map would turn the rail with the arm,
/// and --mount does not.
void refuse_moving_base(const Arm& arm) {
  if (!has_moving_base(arm)) return;
  const Joint& first = arm.joints().front();
  throw Error("the map's arm moves on a rail or a mobile base (joint " + first.name + ", link " +
              first.link +
              "): places are searched for arms whose base stands still; use a map of the arm "
              "without the joints before its own, or test one place by `beeline ik` with --mount");
}

Answer place(PlaceArguments& arguments) {
  arguments.scene.fixed_mount = false;
  const ReachMap map(arguments.map, arguments.options.threads);
  refuse_moving_base(map.arm());
  const PoseList poses = waypoints_from(read_file(arguments.poses), arguments.poses, map.arm(),
                                        {.offered = false}, {}, arguments.unit, "--poses");
  PlacementOptions options = arguments.options;
  if (!arguments.lower.empty()) options.lower = corner_of(arguments.lower, "--lower");
  if (!arguments.upper.empty()) options.upper = corner_of(arguments.upper, "--upper");
  const std::optional<CheckedScene> scene = scene_of(arguments, map.arm());
  if (scene) {
    warn_if_unchecked(*scene);
    options.blocked_by = blocked_at_mounts(scene->model);
  }
  PlacementResult result;
  {
    Progress progress;
    options.budget = progress.of(arguments.budget.next());
    result = find_placements(map, poses.poses, options);
  }
  Answer answer = answer_of(map.arm(), result, arguments);
  if (scene) {
    answer.text += "\n" + scene_text(*scene);
    answer.document.add("scene", scene_document(*scene));
  }
  return answer;
}

std::vector<Option> mount_options(PlaceArguments& arguments) {
  PlacementOptions& options = arguments.options;
  return {
      Option("--lower X,Y,Z",
             "Corner of the box of the mount's positions, m, in the world of the poses. Default: "
             "in x and y where all poses are within reach, at z = 0.",
             &arguments.lower),
      Option("--upper X,Y,Z", "The opposite corner. Default: as --lower.", &arguments.upper),
      Option("--step M", "Distance between mounts, m. Default: the edge of the map's cells.",
             &options.step, {.range = above_zero}),
      Option("--headings N", "Rotations of the mount about the world's z axis, in equal steps.",
             &options.headings, {.range = {1, 360}}),
      Option("--count N", "Placements to print.", &options.count, {.range = {1, 1000}}),
      Option("--max-checked N", "Check at most N mounts, those first which the map ranks first.",
             &options.max_checked, {.range = {1, 1e8}}),
      threads_option(&options.threads)};
}

}  // namespace

Verb reach_place_verb() {
  const auto arguments = std::make_shared<PlaceArguments>();
  return {
      .name = "place",
      .summary = "Where an arm can stand so that it reaches all poses of a list",
      .description =
          "Searches a grid of positions of the mount and of its rotations about the world's z "
          "axis. The map ranks the mounts; each one that is printed was checked by inverse "
          "kinematics at every pose and, with --lines, by a proved motion in straight lines "
          "through them. Printed are the mounts as --mount takes them, those with the largest "
          "margin to the joint limits first: the least margin and the least manipulability over "
          "all poses; at each position the best heading. With --scene, which stands in the world "
          "of the poses while the mount moves, or --self, and with --arm, solutions and lines "
          "count only if each pair of bodies is proved to keep its clearance. Link 0 must keep it "
          "too, except from what it stands on: shapes that end at most 20 mm above its lowest "
          "point, along its z axis. Obstacles in the frame of a link of the base are refused. Exit "
          "code 1: there is none.",
      .arguments = {file_argument("MAP", "A file of `beeline reach map`, not of one orientation.",
                                  &arguments->map)},
      .options =
          joined({{Option("--poses FILE",
                          "The poses in the world, a .csv file as --through of `line` takes it.",
                          &arguments->poses, {.required = true}),
                   Option("--lines",
                          "Only mounts from which the tool moves in straight lines through the "
                          "poses, one after the other.",
                          &arguments->options.lines)},
                  mount_options(*arguments),
                  {Option("--arm FILE",
                          "The file of the map's arm with the shapes of its links, for --scene and "
                          "--self.",
                          &arguments->shaped.text)},
                  arguments->shaped.chain_options(),
                  arguments->scene.distance_options(),
                  arguments->unit.options(),
                  arguments->budget.options()}),
      .examples = {{"Three poses above a table: where can the arm stand?",
                    "beeline reach map puma560 --resolution 0.12 --out puma560.h5\n"
                    "printf 'x,y,z,roll,pitch,yaw\\n0.8,-0.3,0.2,180,0,0\\n0.8,0.3,0.2,180,0,0\\n"
                    "1,0,0.4,180,0,0\\n' > poses.csv\n"
                    "beeline reach place puma560.h5 --poses poses.csv --lines --degrees"}},
      .run = [arguments] { return place(*arguments); }};
}

}  // namespace beeline::command
