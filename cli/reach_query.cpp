#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>

#include "format.h"
#include "pose_argument.h"
#include "reach_totals.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct QueryArguments {
  std::string map, pose;
  UnitArgument unit;
};

bool sampled(const ReachMap& map) { return map.header().samples > 0; }

/// What a map counts in each cell.
const char* counted_name(const ReachMap& map) { return sampled(map) ? "samples" : "branches"; }

/// The best of the cells at a position.
Answer at_position(const ReachMap& map, Eigen::Index p) {
  const ReachPositions best = reach_positions(map.grid(), map.cells(p, p + 1));
  const bool reached = best.branches[0] > 0;
  const Eigen::VectorXd centre = map.grid().centre(p);
  Answer answer;
  answer.yes = reached;
  answer.text = fmt::format("cell            around {} m\n", shown(centre));
  if (map.grid().directions() > 1) {
    answer.text += fmt::format("directions      {:.1f} % reached\n", 100 * best.directions[0]);
  }
  answer.document = {{"status", reached ? "reached" : "not_reached"},
                     {"centre", centre},
                     {"directions", best.directions[0]},
                     {counted_name(map), best.branches[0]}};
  if (!reached) {
    answer.reason = sampled(map)
                        ? "no sample is in the cells of this position"
                        : "the arm reaches the centre of the cell in no orientation of the map";
    return answer;
  }
  answer.text += fmt::format(
      "{:<16}{} at most\nmanipulability  {} at most\n"
      "margin          {} at most\n",
      counted_name(map), best.branches[0], shown(best.manipulability[0]), shown(best.margin[0]));
  answer.document.add("manipulability", static_cast<double>(best.manipulability[0]));
  answer.document.add("margin", static_cast<double>(best.margin[0]));
  return answer;
}

/// The cell of a pose, and the pose itself.
Answer at_pose(const ReachMap& map, Eigen::Index cell, const Pose& pose, const UnitArgument& unit) {
  const ReachGrid& grid = map.grid();
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  const Eigen::Index p = cell / at_position, k = cell % at_position;
  const ReachCells cells = map.cells(p, p + 1);
  const auto at = static_cast<std::size_t>(k);
  const Pose centre = grid.pose(cell);
  const bool any_roll = grid.orientations() == ReachOrientations::directions;
  const bool reached = cells.branches[at] > 0;
  const InverseResult exact =
      inverse_kinematics(map.arm(), pose, {.task = default_task(map.arm())});
  const std::string itself = std::string(exact ? "reached" : name(exact.status)) +
                             (exact && map.header().scene ? ", not checked in the scene" : "");
  Answer answer;
  answer.yes = reached;
  answer.text =
      fmt::format("cell            around {}{}\n", shown(centre, map.arm().planar(), unit),
                  any_roll ? ", with any roll" : "");
  answer.document = {{"status", reached ? "reached" : "not_reached"},
                     {"cell", cell},
                     {"centre", json_pose(centre, map.arm().planar(), unit)},
                     {"any_roll", any_roll},
                     {counted_name(map), cells.branches[at]}};
  if (reached) {
    answer.text +=
        fmt::format("{:<16}{}\nmanipulability  {}\nmargin          {}\n", counted_name(map),
                    cells.branches[at], shown(cells.manipulability[at]), shown(cells.margin[at]));
    answer.document.add("manipulability", static_cast<double>(cells.manipulability[at]));
    answer.document.add("margin", static_cast<double>(cells.margin[at]));
  } else {
    answer.text += fmt::format("{:<16}0\n", counted_name(map));
    answer.reason = (sampled(map) ? "no sample is in the cell; the pose itself: "
                     : map.header().scene
                         ? "no solution at the centre of the cell is free; the pose itself: "
                         : "the arm does not reach the centre of the cell; the pose itself: ") +
                    itself;
  }
  answer.text += "the pose itself " + itself + "\n";
  if (const auto& scene = map.header().scene) {
    answer.text += "free in         " + scene_name(*scene) + "\n";
  }
  answer.document.add("map_scene", scene_document(map));
  answer.document.add("pose_itself", exact ? "solved" : name(exact.status));
  return answer;
}

Answer query(const QueryArguments& arguments) {
  const ReachMap map(arguments.map);
  if (arguments.pose.empty()) return map_totals(map);
  const Arm& arm = map.arm();
  const WrittenPose written =
      in_world(arm, {.pose = Pose::Identity(), .planar = true},
               parse_frame_option(arm, "--pose", arguments.pose, arguments.unit));
  if (written.oriented) check_pose_form(arm, written, {.offered = false});
  warn_of_positions("--pose", arm, std::span(&written.pose, 1), arguments.unit);
  const auto p = map.grid().position_of(written.pose.translation());
  if (!p) {
    return {.text = "outside         the box of the map\n",
            .document = {{"status", "outside_map"}},
            .yes = false,
            .reason = "the position is outside the box of the map"};
  }
  const bool any = map.grid().orientations() == ReachOrientations::any;
  if (!written.oriented || any) return at_position(map, *p);
  return at_pose(map, *map.grid().cell_of(written.pose), written.pose, arguments.unit);
}

}  // namespace

Verb reach_query_verb() {
  const auto arguments = std::make_shared<QueryArguments>();
  return {.name = "query",
          .summary = "What a map says of a pose or a position",
          .description =
              "Prints the cell of the map that contains the pose's position and is nearest in "
              "orientation, what the arm can do at its centre, and whether the arm reaches the "
              "pose itself. A position without orientation is answered with the best of its cells, "
              "and no pose at all with the totals of the map. Exit code 1: not reached.",
          .arguments = {map_argument(&arguments->map)},
          .options =
              joined({{Option("--pose POSE",
                              "x,y,z,roll,pitch,yaw, x,y,z,qw,qx,qy,qz or another --pose-form, in "
                              "the world, or a position x,y,z; x,y,theta or x,y for planar arms.",
                              &arguments->pose)},
                      arguments->unit.options()}),
          .examples = {{"A pose and a position",
                        "beeline reach map puma560 --resolution 0.12 --out puma560.h5\n"
                        "beeline reach query puma560.h5 --pose 0.5,0.1,0.3,180,0,0 --degrees\n"
                        "beeline reach query puma560.h5 --pose 0.5,0.1,0.3"}},
          .run = [arguments] { return query(*arguments); }};
}

}  // namespace beeline::command
