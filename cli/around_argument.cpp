#include "around_argument.h"

#include <algorithm>
#include <fmt/format.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>

#include "blocked_solutions.h"
#include "command/progress.h"
#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "pose_argument.h"
#include "sampling_argument.h"

namespace beeline::command {
namespace {

/// The goals, or why there are none.
struct Goals {
  std::vector<Configuration> configurations = {};
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};
};

Goals solutions_of(const Arm& arm, const Configuration& from, const std::string& text,
                   const CheckedScene& scene, const UnitArgument& unit, const Budget& budget) {
  const WrittenPose goal = parse_pose_option(arm, "--pose", text, unit);
  for_option("--pose", [&] { check_pose_form(arm, goal, {}); });
  warn_of_positions("--pose", arm, std::span(&goal.pose, 1), unit);
  InverseResult found = inverse_kinematics(arm, goal.pose,
                                           {.seed = from,
                                            .all = true,
                                            .every_turn = true,
                                            .blocked_by = blocked_in(scene),
                                            .budget = budget});
  explain(found, budget);
  return {found.solutions, motion_status(found.status), found.reason};
}

std::string path_text(const FreeMotion& motion) {
  const auto edges = static_cast<std::int64_t>(motion.path.waypoints.size()) - 1;
  const auto blends = std::count_if(motion.blends.begin(), motion.blends.end(),
                                    [](double radius) { return radius > 0; });
  return fmt::format("path          {}, length {}, {}; {} examined\n",
                     counted(edges, "straight joint motion"), shown(motion.path.length),
                     counted(blends, "blend"),
                     counted(static_cast<std::int64_t>(motion.path.edges), "motion"));
}

Json path_document(const Arm& arm, const FreeMotion& motion, const UnitArgument& unit) {
  Json waypoints = Json::list();
  for (const Configuration& q : motion.path.waypoints) waypoints.append(unit.shown(arm, q));
  return {{"waypoints", waypoints},
          {"blends", json_blends(motion.blends)},
          {"length", motion.path.length},
          {"edges", motion.path.edges}};
}

/// What the reason of a refusal adds if the start is not free.
std::string clause_of(const FreeMotion& motion, const SceneArgument& scene_argument,
                      const CheckedScene& scene, const Configuration& start) {
  const bool at_start = motion.reason.code == ReasonCode::start_not_free;
  return at_start ? scene_argument.start_clause(scene, start,
                                                "; no straight joint motion out of it was found") +
                        exemption_clause(scene, start)
                  : "";
}

/// Adds the fractions of the limits that a motion uses, and where the tool ends.
void add_end(const Arm& arm, const FreeMotion& found, const UnitArgument& unit, Answer& answer) {
  answer.text += position_text(found.limits) + limits_text(found.limits);
  answer.document.add("limits", json_limits(found.limits));
  answer.document.add(
      "tool_at_goal",
      json_pose(forward_kinematics(arm, found.trajectory.positions.back()), arm.planar(), unit));
}

}  // namespace

std::vector<Option> AroundArgument::options() {
  const std::vector<std::string> methods = {method};
  return {
      Option("--pose POSE",
             "The goal as a pose of the tool, as in `beeline ik`, instead of --to: a solution "
             "of inverse kinematics that can be reached.",
             &pose, {.methods = methods}),
      Option("--shortcuts N", "Number of shortcuts that are tried on the path.", &motion.shortcuts,
             {.methods = methods}),
      Option("--max-edges N", "Largest number of straight joint motions that the search examines.",
             &motion.max_edges, {.methods = methods}),
      Option("--random-seed N", "Seed of the search; the same seed gives the same motion.",
             &motion.random_seed, {.methods = methods})};
}

Answer AroundArgument::answer(const Arm& arm, const Configuration& from,
                              const std::optional<Configuration>& to,
                              const SceneArgument& scene_argument, const CheckedScene& scene,
                              const UnitArgument& unit, const JointPathArgument& path,
                              const BudgetArgument& budget, const ResultFiles& files) const {
  const Goals goals = to ? Goals{{*to}} : solutions_of(arm, from, pose, scene, unit, budget.next());
  FreeMotion found;
  found.status = goals.status;
  found.reason = goals.reason;
  if (!goals.configurations.empty()) {
    FreeMotionOptions options = motion;
    path.set_on(options);
    options.recover_clearance = scene_argument.recover_clearance.value_or(0);
    Progress progress;
    options.budget = progress.of(budget.next());
    found = move_around(scene.model, from, goals.configurations, options);
  }
  std::optional<ClearanceReport> clearance;
  if (found) {
    clearance = scene_argument.prove(scene, found.trajectory, budget.next());
    found.status = clearance->refusal();
    found.reason = clearance->proof.reason;
  }
  const bool reached(found);
  if (clearance) files.draw_refusal(*clearance);
  if (reached) {
    const Pose goal = forward_kinematics(arm, found.trajectory.positions.back());
    files.write(arm, found.trajectory, {goal}, {.waypoint_times = {found.trajectory.times.back()}},
                std::nullopt, &scene.model);
  }
  Answer answer{
      .text =
          name(found.status) + (reached ? " after " + shown(found.duration()) + " s" : "") + "\n",
      .document = {{"status", name(found.status)},
                   {"method", method},
                   {"samples", found.trajectory.size()},
                   {"duration", reached ? Json(found.duration()) : Json()}},
      .yes = reached,
      .reason = clearance ? clearance->reason_text()
                          : sentence(found.reason) + clause_of(found, scene_argument, scene, from)};
  answer.document.add(json_reason(found.reason));
  if (!found.path.waypoints.empty()) {
    answer.text += path_text(found);
    answer.document.add("path", path_document(arm, found, unit));
  }
  if (reached) {
    add_end(arm, found, unit, answer);
  }
  if (clearance) {
    answer.text += clearance->text();
    answer.document.add("clearance", clearance->document());
  }
  if (reached) {
    answer.text += files.text();
    files.add_to(answer.document);
  }
  return answer;
}

}  // namespace beeline::command
