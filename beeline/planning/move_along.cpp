#include <algorithm>
#include <ostream>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/planning/internal/inset_limits.h>
#include <beeline/planning/internal/motion_proof.h>
#include <beeline/planning/internal/timed_plan.h>
#include <beeline/planning/internal/track_branch.h>
#include <beeline/planning/move_along.h>
#include <beeline/timing/internal/timed_path.h>
#include <beeline/trajectory/internal/given_duration.h>

namespace beeline {

using namespace internal;

namespace {

constexpr double planned_fraction = 0.9;        // of the tolerance; timing may use the remainder
constexpr double interpolated_fraction = 0.01;  // the same, for the joint path between samples

constexpr double planning_share = 0.5;                 // of the progress
constexpr std::int64_t max_suggestion_work = 400'000;  // of all suggestions of a refusal

// Samples of each segment of the plan that the joint path passes through: with few it is smooth,
// with many it stays near the plan, as next to limits.
constexpr std::size_t few_samples = 32, many_samples = 128;

/// Throws Error for tolerances, speeds, rates or numbers of samples out of range.
void check_options(const PathMotionOptions& options) {
  const std::pair<const char*, double> positives[] = {
      {"tolerance", options.tolerance}, {"orientation_tolerance", options.orientation_tolerance}};
  for (const auto& [option, value] : positives) {
    if (value >= min_tolerance) continue;
    throw Error(std::string(option) + " must be at least " + number(min_tolerance) + ", not " +
                number(value));
  }
  internal::check_options(options.tool_speed, options.rate);
  check_duration(options.duration);
  refuse_duration_with_rate(options.duration, options.rate);
  if (options.max_samples < 2) {
    throw Error("max_samples must be at least 2, not " + std::to_string(options.max_samples));
  }
}

void check_stops(const Route& route) {
  const auto stops =
      static_cast<std::size_t>(std::count(route.stops.begin(), route.stops.end(), true));
  if (stops <= max_stops) return;
  throw Error("the path has " + std::to_string(stops) + " stops; a motion has at most " +
              std::to_string(max_stops) + ": plan it in parts, or blend the lines");
}

Deviation part_of_tolerance(const PathMotionOptions& options, double fraction) {
  return {fraction * options.tolerance, fraction * options.orientation_tolerance};
}

/// Returns the start, clamped to the limits. Throws Error if it exceeds them by more than rounding.
Configuration checked_start(const Arm& arm, const Configuration& start) {
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  const Bounds bounds = bounds_of(arm);
  return start.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
}

/// Sets the status and reason of a motion that the budget ended after its branch was planned.
void set_ended(Ending ending, PathMotion& motion) {
  motion.status = status_of<MotionStatus>(ending);
  motion.reason = ended_by(ending) +
                  " after the whole path was planned, before the motion was timed "
                  "and proved" +
                  how_to_continue(ending);
}

RetimeOptions timing_options(const PathMotionOptions& options) {
  return {.profile = options.profile,
          .interpolation = options.interpolation,
          .tool_speed = options.tool_speed,
          .rate = options.rate,
          .max_samples = options.max_samples};
}

/// Whether the motion is proved as it is timed now.
bool is_proved(const Arm& arm, const Route& route, const Task& task,
               const PathMotionOptions& options, BudgetMeter& budget, PlanTiming& timing) {
  if (timing.status != MotionStatus::reached) return false;
  TimedPlan timed = timing.sample();
  if (budget.ended() || timing.status != MotionStatus::reached) return false;
  PathMotion tried;
  tried.status = MotionStatus::reached;
  tried.trajectory = std::move(timed.trajectory);
  tried.path_parameters = std::move(timed.path_parameters);
  prove(arm, route, task, options, budget, tried);
  return tried && budget.complete();
}

/// The lowest of the usual rates above the one asked for at which the motion is proved; 0: none.
double proved_rate(const Arm& arm, const Route& route, const Task& task,
                   const PathMotionOptions& options, BudgetMeter& budget, PlanTiming& timing) {
  for (const double rate : {50, 100, 125, 250, 500, 1000, 2000, 4000, 8000}) {
    if (!(rate > options.rate)) continue;
    timing.set_rate(rate);
    if (is_proved(arm, route, task, options, budget, timing)) return rate;
    if (budget.ended() || timing.status != MotionStatus::reached) break;
  }
  return 0;
}

/// The largest of some speed scales with which the motion is proved at the rate asked for; 0: none.
double proved_speed(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                    std::size_t samples, const PathMotionOptions& options, BudgetMeter& budget) {
  for (const double scale : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
    const Arm slower = with_speed_scale(arm, scale);
    PlanTiming timing(slower, route, plan, task, part_of_tolerance(options, interpolated_fraction),
                      samples, timing_options(options), budget);
    if (is_proved(slower, route, task, options, budget, timing)) return scale;
    if (budget.ended() || timing.status != MotionStatus::reached) break;
  }
  return 0;
}

/// Returns a branch as a motion with times and its proof, or the reason why there is none. Without
/// a rate, takes samples closer together where the motion is not proved.
PathMotion timed(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                 std::size_t samples, const PathMotionOptions& options, BudgetMeter& whole) {
  const Budget share = whole.part(planning_share, 1);
  BudgetMeter budget(share);
  PathMotion motion;
  motion.status = plan.status;
  motion.reason = plan.reason;
  motion.path_parameter = plan.path_parameter;
  if (!plan) return motion;
  motion.limit_margin = plan.limit_margin;
  motion.inverse_condition = plan.inverse_condition;
  PlanTiming timing(arm, route, plan, task, part_of_tolerance(options, interpolated_fraction),
                    samples, timing_options(options), budget);
  motion.status = timing.status;
  motion.reason = timing.reason;
  if (!motion) return motion;
  constexpr int max_rounds = 12;
  for (int round = 0; round < max_rounds && !budget.ended(); ++round) {
    motion.status = MotionStatus::reached;
    motion.reason.clear();
    TimedPlan timed = timing.sample();
    if (budget.ended()) break;
    if (timing.status != MotionStatus::reached) {
      motion.status = timing.status;
      motion.reason = timing.reason;
      return motion;
    }
    motion.trajectory = std::move(timed.trajectory);
    motion.path_parameters = std::move(timed.path_parameters);
    const auto fault = first_joint_fault(arm, motion.trajectory);
    if (fault && fault->kind == Fault::limits) {
      motion.status = MotionStatus::outside_limits;
      motion.reason = fault->reason;
      return motion;
    }
    const std::size_t faulty = prove(arm, route, task, options, budget, motion);
    if (!budget.complete()) break;
    if (motion || options.rate > 0) break;
    const std::vector<int> times = divisions(motion.deviation, faulty, options);
    if (times.empty()) {
      motion.status = MotionStatus::too_many_samples;
      motion.reason += ", or more than " + std::to_string(options.max_samples) + " samples";
      break;
    }
    timing.divide(times);
  }
  if (motion.status == MotionStatus::not_proved && options.rate > 0) {
    motion.reason = "at " + number(options.rate) + " samples per second " + motion.reason;
    const double rate = proved_rate(arm, route, task, options, budget, timing);
    if (rate > 0) motion.reason += ", or a rate of " + number(rate);
    const double speed = proved_speed(arm, route, plan, task, samples, options, budget);
    if (speed > 0) motion.reason += ", or " + number(speed) + " times the speed";
  }
  if (!budget.complete()) set_ended(budget.ending(), motion);
  return motion;
}

/// Plans and times again with other options, because a smooth motion of a joint along its limit may
/// exceed it between samples. Replaces `motion` by the first that does not and is proved, or by one
/// that is not proved at the rate.
void retry_inside_limits(const Arm& arm, const std::optional<Configuration>& start,
                         const Route& route, const BranchOptions& planning,
                         const PathMotionOptions& options, BudgetMeter& budget,
                         PathMotion& motion) {
  // Inset of the limits, radians or metres, and fraction of the tolerance, smallest change first.
  // The steps of a plan are proportional to the square root of its tolerance.
  constexpr std::pair<double, double> attempts[] = {
      {0, 1}, {1e-4, 1}, {3e-4, 1}, {1e-3, 1}, {1e-2, 1}, {1e-4, 1.0 / 64}, {1e-3, 1.0 / 64}};
  for (const auto& [inset, fraction] : attempts) {
    if (budget.ended()) return set_ended(budget.ending(), motion);
    BranchOptions again = planning;
    again.tolerance.position *= fraction;
    again.tolerance.orientation *= fraction;
    Branch plan = plan_path(with_inset_limits(arm, start, inset), start, route.path, again);
    if (plan) measure(arm, planning.task, budget, plan);
    PathMotion inside = timed(arm, route, plan, planning.task, many_samples, options, budget);
    // Within the limits, but not proved at the rate: the reason names what the user can change.
    const bool proof_fails = inside.status == MotionStatus::not_proved && options.rate > 0;
    if (inside || (plan && proof_fails)) motion = std::move(inside);
    if (motion) return;
  }
  if (!budget.complete()) set_ended(budget.ending(), motion);
}

/// Plans, times and proves a motion, or returns the reason why there is none.
PathMotion planned_motion(const Arm& arm, const std::optional<Configuration>& start,
                          const Route& route, const BranchOptions& planning,
                          const PathMotionOptions& options, BudgetMeter& budget) {
  const Branch plan = plan_path(arm, start, route.path, planning);
  PathMotion motion = timed(arm, route, plan, planning.task, few_samples, options, budget);
  if (plan && motion.status == MotionStatus::outside_limits) {
    retry_inside_limits(arm, start, route, planning, options, budget, motion);
  }
  motion.path_parameter = plan.path_parameter;
  return motion;
}

/// Whether the motion is planned, timed and proved with the options. If their rate gives twice the
/// samples that the motion needs, the proof without a rate counts: it takes far less time.
bool is_possible(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                 const BranchOptions& planning, const PathMotionOptions& options,
                 BudgetMeter& budget) {
  constexpr double dense = 2;
  PathMotionOptions without_rate = options;
  without_rate.rate = 0;
  const PathMotion motion = planned_motion(arm, start, route, planning, without_rate, budget);
  if (!motion || options.rate == 0) return static_cast<bool>(motion);
  const double samples = motion.trajectory.times.back() * options.rate;
  if (samples >= dense * static_cast<double>(motion.trajectory.size())) {
    return samples < options.max_samples;
  }
  return static_cast<bool>(planned_motion(arm, start, route, planning, options, budget));
}

/// Searches for nearby paths and another start with which the motion is possible, within a limit
/// of work.
std::vector<NearbyPath> suggestions(const Arm& arm, const std::optional<Configuration>& start,
                                    const Route& route, const BranchOptions& given,
                                    const PathMotionOptions& options, BudgetMeter& whole) {
  Budget limited = whole.part();
  limited.max_work = max_suggestion_work;
  BudgetMeter budget(limited);
  BranchOptions planning = given;
  planning.budget = budget.part(0, planning_share);
  std::vector<NearbyPath> found;
  const auto add_if_possible = [&](NearbyPath nearby, const std::optional<Configuration>& from) {
    Route moved = route;
    moved.path = nearby.path;
    if (is_possible(arm, from, moved, planning, options, budget)) {
      found.push_back(std::move(nearby));
    }
  };
  if (start) {
    const Branch free = plan_path(arm, std::nullopt, route.path, planning);
    if (free) {
      add_if_possible({.path = route.path,
                       .start = free.start,
                       .description = "from another configuration at the start"},
                      free.start);
    }
  }
  for (const bool rotate : {false, true}) {
    auto nearby = nearby_path(arm, start, route.path, planning, rotate);
    if (nearby) add_if_possible(std::move(*nearby), start);
  }
  return found;
}

/// Slows a planned motion down to the duration, and proves it again.
void keep_duration(const Arm& arm, const Route& route, const Task& task,
                   const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion) {
  const std::string reason = set_duration(motion.trajectory, *options.duration);
  if (reason.empty()) {
    prove(arm, route, task, options, budget, motion);
    if (!budget.complete()) set_ended(budget.ending(), motion);
  } else {
    motion.status = MotionStatus::outside_limits;
    motion.reason = reason;
  }
}

PathMotion move(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                const Task& task, const PathMotionOptions& options) {
  BudgetMeter budget(options.budget);
  const BranchOptions planning{.task = task,
                               .tolerance = part_of_tolerance(options, planned_fraction),
                               .max_samples = static_cast<std::size_t>(options.max_samples),
                               .budget = budget.part(0, planning_share)};
  PathMotion motion = planned_motion(arm, start, route, planning, options, budget);
  const bool followed(motion);
  if (followed && options.duration) {
    keep_duration(arm, route, task, options, budget, motion);
  }
  if (motion) {
    budget.report(1);
    return motion;
  }
  PathMotion failure;
  failure.status = motion.status;
  failure.reason = motion.reason;
  failure.path_parameter = motion.path_parameter;
  const bool quick = arm.dof() <= task.size() + 1;  // a plan takes long with more redundancy
  const bool planned = motion.path_parameter == static_cast<double>(route.path.segments.size());
  const bool off_path = !planned || motion.status == MotionStatus::outside_limits;
  if (followed || !options.suggest || !quick || !off_path || !budget.complete()) return failure;
  failure.nearby = suggestions(arm, start, route, planning, options, budget);
  if (!budget.complete()) failure.reason += "; " + ended_by(budget.ending()) + " for paths near it";
  return failure;
}

}  // namespace

PathMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const PathMotionOptions& options) {
  constexpr double start_tolerance = 1e-8;  // metres and radians
  check_options(options);
  const Task task = options.task.value_or(default_task(arm));
  check_route(arm, route, task);
  check_stops(route);
  if (!start) return move(arm, start, route, task, options);
  const Configuration from = checked_start(arm, *start);
  const Deviation off = task_deviation(task, pose_at(route.path, 0), forward_kinematics(arm, from));
  if (!within(off, {start_tolerance, start_tolerance})) {
    throw Error("the motion cannot start: the tool is " + deviation_text(off) +
                " away from the path's beginning");
  }
  return move(arm, from, route, task, options);
}

PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options) {
  check_options(options);
  std::vector<Pose> poses = checked_waypoints(waypoints);
  const Configuration q = checked_start(arm, start);
  poses.insert(poses.begin(), forward_kinematics(arm, q));
  return move_along(arm, q, route_of(lines_through(poses), PathKind::line), options);
}

PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::initializer_list<Pose> waypoints, const PathMotionOptions& options) {
  return move_in_lines(arm, start, std::span<const Pose>(waypoints.begin(), waypoints.size()),
                       options);
}

PathMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const PathMotionOptions& options) {
  check_options(options);
  return move_along(arm, std::nullopt, route_of(lines_through(poses), PathKind::line), options);
}

PathMotion move_in_lines(const Arm& arm, std::initializer_list<Pose> poses,
                         const PathMotionOptions& options) {
  return move_in_lines(arm, std::span<const Pose>(poses.begin(), poses.size()), options);
}

std::ostream& operator<<(std::ostream& out, const PathMotion& motion) {
  if (!motion) return out << motion.status << ": " << motion.reason;
  return out << motion.status << " in " << number(motion.trajectory.times.back()) << " s, "
             << motion.trajectory.size() << " samples, deviation at most "
             << motion.deviation.bound;
}

}  // namespace beeline
