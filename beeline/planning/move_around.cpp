#include <algorithm>
#include <limits>
#include <ostream>

#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/planning/free_path.h>
#include <beeline/planning/internal/clearance_exit.h>
#include <beeline/planning/internal/free_edges.h>
#include <beeline/planning/internal/unblocked_motion.h>
#include <beeline/timing/internal/blended_path.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline {

using namespace internal;

namespace {

constexpr int halvings = 5;        // of a blend that is not proved, before it is a stop
constexpr double at_start = 1e-9;  // length of a path to a goal that is the start

/// Returns the radius of the largest blend, half of it or a quarter and so on, that is proved.
double proved_radius(FreeEdges& edges, const std::vector<std::string>& names, JointBlend blend) {
  if (turns_back(blend)) return 0;
  for (int i = 0; i <= halvings && blend.radius >= least_blend; ++i, blend.radius /= 2) {
    if (edges.is_free(blend.curve(names))) return blend.radius;
  }
  return 0;
}

RetimeOptions timing_of(const FreeMotionOptions& options) {
  return {.profile = options.profile,
          .interpolation = options.interpolation,
          .joint_blend = options.joint_blend,
          .speed_scale = options.speed_scale,
          .tool_speed = options.tool_speed,
          .rate = options.rate,
          .duration = options.duration,
          .max_samples = options.max_samples};
}

/// A rest, for a goal that is the start: one sample or, with a duration, two.
Retimed rest_at(const Arm& arm, const Configuration& q, const std::optional<double>& duration) {
  const Configuration none = Configuration::Zero(q.size());
  Retimed timed;
  timed.trajectory = {arm.joint_names(), {0}, {q}, {none}, {none}};
  if (duration) append_sample(timed.trajectory, timed.trajectory, 0, *duration);
  timed.limits = limit_usage(arm, timed.trajectory);
  return timed;
}

MotionStatus status_of_timing(const Reason& reason) {
  const bool too_many = reason.code == ReasonCode::too_many_samples_at_rate ||
                        reason.code == ReasonCode::too_many_samples_given;
  return too_many ? MotionStatus::too_many_samples : MotionStatus::outside_limits;
}

/// The motion along the path of `motion`, timed and proved, or why there is none.
void time_and_prove(const CollisionModel& model, const FreeMotionOptions& options,
                    BudgetMeter& budget, FreeMotion& motion) {
  const Arm& arm = model.arm();
  const std::vector<Configuration>& waypoints = motion.path.waypoints;
  Retimed timed =
      motion.path.length > at_start
          ? retimed_paths(arm, blended_paths(waypoints, motion.blends), timing_of(options), budget)
          : rest_at(arm, waypoints.front(), options.duration);
  if (!timed) {
    motion.status = budget.complete() ? status_of_timing(timed.reason)
                                      : status_of<MotionStatus>(budget.ending());
    motion.reason = std::move(timed.reason);
    return;
  }
  motion.clearance = prove_clearance(
      model, timed.trajectory,
      {.closest = true, .recover_clearance = options.recover_clearance, .budget = budget.part()});
  motion.reason = motion.clearance.reason;
  if (motion.clearance) {
    motion.status = MotionStatus::reached;
    motion.trajectory = std::move(timed.trajectory);
    motion.limits = timed.limits;
    return;
  }
  motion.status = status_of_blocked(motion.reason);
}

/// Puts the motion out of the clearance before the path, with a stop after it; before the path of a
/// goal that it reaches, instead of it.
void begin_with(const Configuration& start, FreeMotion& motion) {
  std::vector<Configuration>& waypoints = motion.path.waypoints;
  const bool is_at_goal = motion.path.length <= at_start;
  if (is_at_goal) waypoints.erase(waypoints.begin() + 1, waypoints.end());
  motion.path.length += (waypoints.front() - start).norm();
  waypoints.insert(waypoints.begin(), start);
  if (!is_at_goal) motion.blends.push_back(0);
}

/// Replaces the motion by the one that stops where its blends are smaller than a radius, if there
/// are such blends and that motion is quicker, or the only one.
void with_stops_at(double radius, const CollisionModel& model, const FreeMotionOptions& options,
                   BudgetMeter& budget, FreeMotion& motion) {
  FreeMotion stopping{.path = motion.path, .blends = with_stops_below(radius, motion.blends)};
  if (stopping.blends == motion.blends) return;
  time_and_prove(model, options, budget, stopping);
  if (stopping && (!motion || stopping.duration() < motion.duration()))
    motion = std::move(stopping);
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const FreeMotion& motion) {
  out << motion.status;
  if (!motion) return out << ": " << motion.reason;
  return out << " in " << number(motion.duration()) << " s, " << motion.trajectory.size()
             << " samples; " << motion.clearance;
}

FreeMotion move_around(const CollisionModel& model, const Configuration& start,
                       std::span<const Configuration> goals, const FreeMotionOptions& options) {
  check_options(timing_of(options));
  BudgetMeter budget(options.budget);
  check_recover_clearance(options.recover_clearance);
  check_configuration(model.arm(), start);
  std::optional<Configuration> exit;
  if (options.recover_clearance > 0) {
    exit = clearance_exit(model, start, options.recover_clearance, budget);
  }
  FreeMotion motion;
  if (!exit && !budget.complete()) {
    set_ended(ReasonCode::ended_before_free_path, budget.ending(), motion);
    motion.reason.set(ReasonField::count, motion.path.edges);
    return motion;
  }
  motion.path = find_free_path(model, exit.value_or(start), goals,
                               {.random_seed = options.random_seed,
                                .max_edges = options.max_edges,
                                .shortcuts = options.shortcuts,
                                .budget = budget.part()});
  motion.status = motion.path.status;
  motion.reason = motion.path.reason;
  if (!motion.path) return motion;
  const std::vector<Configuration>& waypoints = motion.path.waypoints;
  if (exit) begin_with(start, motion);
  FreeEdges edges(model, std::numeric_limits<int>::max(), budget);
  for (std::size_t k = 1 + motion.blends.size(); k + 1 < waypoints.size(); ++k) {
    motion.blends.push_back(proved_radius(edges, model.bodies().joint_names,
                                          largest_blend(waypoints, k, options.joint_blend)));
  }
  time_and_prove(model, options, budget, motion);
  with_stops_at(small_blend, model, options, budget, motion);
  // A trajectory differs from its path by its interpolation between samples, most at a low rate.
  const bool can_stop = motion.status == MotionStatus::not_decided ||
                        motion.status == MotionStatus::collides ||
                        motion.status == MotionStatus::outside_limits;
  if (can_stop) with_stops_at(Limits::none, model, options, budget, motion);
  return motion;
}

}  // namespace beeline
