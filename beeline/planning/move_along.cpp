#include <algorithm>
#include <ostream>
#include <utility>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/printed_bound.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/motion_along.h>
#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/printed_motion.h>
#include <beeline/planning/internal/track_segment.h>
#include <beeline/planning/internal/unblocked_motion.h>
#include <beeline/planning/move_along.h>
#include <beeline/timing/internal/recovery_section.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline {

using namespace internal;

namespace {

constexpr double planned_fraction = 0.9;  // of the tolerance; timing may use the remainder

constexpr std::int64_t max_suggestion_work = 400'000;  // of all suggestions of a refusal
// Of one nearby_path(): less than its own limit, so that its end is known here.
constexpr std::int64_t max_suggested_path_work = max_nearby_path_work / 10 * 9;

/// Throws Error for tolerances, speeds, rates, durations or numbers of samples out of range.
void check_motion_options(const PathMotionOptions& options) {
  const std::pair<const char*, double> positives[] = {
      {"tolerance", options.tolerance}, {"orientation_tolerance", options.orientation_tolerance}};
  for (const auto& [option, value] : positives) {
    if (value >= min_tolerance) continue;
    throw Error("", option,
                " must be at least " + number(min_tolerance) + ", not " + number(value));
  }
  internal::check_options(timing_options(options));
  check_recover(options.recover);
  check_recover_clearance(options.recover_clearance);
  if (options.recover_clearance > 0 && !options.blocked_by.reason) {
    throw Error("", "recover_clearance", " needs blocked_by");
  }
  if (options.blocked_by.spare_clearance && !options.blocked_by.reason) {
    throw Error::of("blocked_by", "spare_clearance of blocked motions needs a reason beside it");
  }
}

void check_stops(const Route& route) {
  const auto stops =
      static_cast<std::size_t>(std::count(route.stops.begin(), route.stops.end(), true));
  if (stops <= max_stops) return;
  throw Error("the path has " + std::to_string(stops) + " stops; a motion has at most " +
              std::to_string(max_stops) + ": plan it in parts, or blend the lines");
}

/// Returns the start, clamped to the limits. Throws Error if it exceeds them by more than rounding,
/// or than the options accept.
Configuration checked_start(const Arm& arm, const Configuration& start,
                            const PathMotionOptions& options) {
  starts_outside(arm, start, options.recover);
  return nearest_within_limits(arm, start);
}

/// Whether the motion is planned, timed, proved and not blocked.
bool is_possible(const MotionRequest& request, const BlockedMotions& blocked_by,
                 BudgetMeter& budget) {
  const PathMotion motion = planned_motion_in_time(request, budget);
  const bool blocked = motion && blocked_by.reason &&
                       blocked_reason(blocked_by, request.clearance, budget, motion.trajectory);
  return motion && !blocked && budget.complete();
}

struct Suggestions {
  std::vector<NearbyPath> found = {};
  bool complete = true;  ///< whether no limit of work ended a search
};

/// Searches for nearby paths and another start with which the motion is possible.
Suggestions suggestions(const MotionRequest& request, const BlockedMotions& blocked_by,
                        BudgetMeter& whole) {
  const Arm& arm = request.arm;
  const std::optional<Configuration>& start = request.start;
  const Route& route = request.route;
  Budget limited = whole.part();
  limited.max_work = max_suggestion_work;
  BudgetMeter budget(limited);
  BranchOptions options = request.branch;
  options.spare_clearance = blocked_by.spare_clearance;
  options.budget = budget.part(0, planning_share);
  Suggestions result;
  const auto add_if_possible = [&](NearbyPath nearby, const std::optional<Configuration>& from) {
    Route other = route;
    other.path = nearby.path;
    const MotionRequest nearby_request{
        arm, from, other, options, request.timing, request.proof, request.clearance};
    if (is_possible(nearby_request, blocked_by, budget)) {
      result.found.push_back(std::move(nearby));
    }
  };
  if (start) {
    const Branch free = plan_path(arm, std::nullopt, route.path, options);
    if (free && free.spare_clearance >= 0) {
      add_if_possible({.path = route.path,
                       .start = free.start,
                       .description = "from another configuration at the start"},
                      free.start);
    }
  }
  const bool keeps_blocked_start =
      start && options.spare_clearance && options.spare_clearance(*start) < 0;
  for (const bool rotate : {false, true}) {
    if (keeps_blocked_start) break;
    Budget part = budget.part();
    part.max_work = max_suggested_path_work;
    BudgetMeter search(part);
    BranchOptions searched = options;
    searched.budget = search.part();
    auto nearby = nearby_path(arm, start, route.path, searched, rotate);
    result.complete = result.complete && search.complete();
    if (nearby) add_if_possible(std::move(*nearby), start);
  }
  result.complete = result.complete && budget.complete();
  return result;
}

/// Plans the motion along a route; if it is not possible, searches for what is near it.
PathMotion planned_or_suggestions(const Arm& arm, const std::optional<Configuration>& start,
                                  const Route& route, const PathMotionOptions& options,
                                  BudgetMeter& budget) {
  MotionRequest request{arm,
                        start,
                        route,
                        branch_options(arm, options, planned_fraction),
                        timing_options(options),
                        proof_options(options),
                        clearance_options(options)};
  request.branch.budget = budget.part(0, planning_share);
  PathMotion motion = planned_motion(request, budget);
  const bool followed(motion);
  if (followed && options.duration) keep_duration(request, budget, motion);
  const bool timed(motion);
  if (motion && options.blocked_by.reason) {
    motion = unblocked_motion(request, options.blocked_by, std::move(motion), budget);
  }
  if (motion) {
    budget.report(1);
    return motion;
  }
  PathMotion failure;
  failure.status = motion.status;
  failure.reason = motion.reason;
  failure.path_parameter = motion.path_parameter;
  failure.blocked = std::move(motion.blocked);
  failure.trajectory = std::move(motion.trajectory);
  failure.path_parameters = std::move(motion.path_parameters);
  failure.deviation = std::move(motion.deviation);
  // A plan takes long with more redundancy.
  const bool quick = arm.dof() <= independent_rows(arm, request.task()).size() + 1;
  const bool planned = motion.path_parameter == static_cast<double>(route.path.segments.size());
  const bool off_path = !planned || motion.status == MotionStatus::outside_limits;
  const bool may_be_nearby = timed || (!followed && off_path);
  if (timed && !budget.complete()) failure.reason.set(ReasonField::search_ending, budget.ending());
  if (!options.suggest || !quick || !may_be_nearby || !budget.complete()) return failure;
  Suggestions near = suggestions(request, options.blocked_by, budget);
  failure.nearby = std::move(near.found);
  if (!budget.complete()) {
    failure.reason.set(ReasonField::search_ending, budget.ending());
  } else if (!near.complete) {
    failure.reason.set(ReasonField::search_limited, true);
  }
  return failure;
}

/// Sets why a motion that begins with a recovery is refused.
void set_refused(MotionStatus status, Reason reason, BudgetMeter& budget, PathMotion& motion) {
  const bool ended = !budget.complete();
  refuse(ended ? status_of<MotionStatus>(budget.ending()) : status,
         ended ? ended_reason(ReasonCode::ended_before_timing, budget.ending()) : std::move(reason),
         motion);
}

/// Puts the section that recovers from the start before a planned motion, slows it down to the
/// options' duration, and proves the whole.
void begin_with_recovery(const Arm& arm, const Trajectory& section, const Route& route,
                         const PathMotionOptions& options, BudgetMeter& budget,
                         PathMotion& motion) {
  put_before(section, motion.trajectory);
  if (options.duration) {
    Reason reason = set_duration(motion.trajectory, *options.duration);
    if (reason) {
      return set_refused(MotionStatus::outside_limits, std::move(reason), budget, motion);
    }
  }
  VerifyOptions proof = proof_options(options);
  proof.recover = options.recover;
  proof.budget = budget.part();
  Verification proved = verify(arm, motion.trajectory, route, proof);
  if (!proved) {
    return set_refused(MotionStatus::not_proved, std::move(proved.reason), budget, motion);
  }
  motion.deviation = std::move(proved.deviation);
  motion.path_parameters = std::move(proved.path_parameters);
  motion.arrivals = std::move(proved.arrivals);
  motion.recovery = std::move(proved.recovery);
  motion.limits = limit_usage(arm, motion.trajectory, budget.part());
  if (!budget.complete()) return set_refused(MotionStatus::not_proved, {}, budget, motion);
  if (!options.blocked_by.reason) return;
  Reason blocked =
      blocked_reason(options.blocked_by, clearance_options(options), budget, motion.trajectory);
  const MotionStatus status = status_of_blocked(blocked);
  if (blocked) set_refused(status, std::move(blocked), budget, motion);
}

/// Plans the motion along a route from a start outside the limits, which begins with a recovery.
/// Its budget and its samples are counted once, as a whole.
PathMotion recovering_motion(const Arm& arm, const Configuration& start, const Route& route,
                             const PathMotionOptions& options, BudgetMeter& budget) {
  constexpr double planned = 0.9;  // of the progress
  PathMotion motion;
  const Retimed section = recovery_section(arm, start, timing_options(options), budget);
  const bool too_many = section.reason.code == ReasonCode::too_many_samples_at_rate;
  if (!section) {
    set_refused(too_many ? MotionStatus::too_many_samples : MotionStatus::outside_limits,
                section.reason, budget, motion);
    return motion;
  }
  SamplesBehind behind = samples_behind(section.trajectory, options.max_samples);
  if (behind.reason) {
    set_refused(MotionStatus::too_many_samples, std::move(behind.reason), budget, motion);
    return motion;
  }
  PathMotionOptions after = options;
  after.duration.reset();
  after.max_samples = behind.max_samples;
  after.budget = budget.part(0, planned);
  BudgetMeter planning(after.budget);
  motion = planned_or_suggestions(arm, section.trajectory.positions.back(), route, after, planning);
  set_max_samples(options.max_samples, motion.reason);
  if (motion) begin_with_recovery(arm, section.trajectory, route, options, budget, motion);
  if (motion) budget.report(1);
  return motion;
}

}  // namespace

BlockedMotions blocked_motions(const std::shared_ptr<const CollisionModel>& model) {
  return {.reason =
              [model](const Trajectory& motion, const ClearanceOptions& options) {
                return prove_clearance(*model, motion, options).reason;
              },
          .spare_clearance =
              [model](const ConfigurationRef& q) {
                return spare_clearance(*model, q, enough_spare_clearance);
              }};
}

BlockedMotions blocked_motions(const CollisionModel& model) {
  return blocked_motions(std::shared_ptr<const CollisionModel>(std::shared_ptr<void>(), &model));
}

PathMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const PathMotionOptions& options) {
  PathMotion motion = motion_along(arm, start, route, options);
  if (motion) return motion;
  motion.trajectory = {};
  motion.path_parameters = {};
  motion.deviation = {};
  return motion;
}

PathMotion internal::motion_along(const Arm& arm, const std::optional<Configuration>& start,
                                  const Route& route, const PathMotionOptions& options) {
  check_motion_options(options);
  const Task task = options.task.value_or(default_task(arm));
  check_route(arm, route, task);
  check_in_plane(arm, route.path, options.task);
  check_stops(route);
  BudgetMeter budget(options.budget);
  if (!start && options.recover_clearance > 0) {
    throw Error("", "recover_clearance", " needs a start");
  }
  if (!start) return planned_or_suggestions(arm, start, route, options, budget);
  const Configuration from = checked_start(arm, *start, options);
  const Deviation off = task_deviation(task, pose_at(route.path, 0), forward_kinematics(arm, from));
  const double near = start_tolerance(arm);
  if (!within(off, {near, near})) {
    throw Error::of("start", "the motion cannot start: the tool is " + deviation_text(off) +
                                 " away from the path's beginning");
  }
  if (starts_outside(arm, *start, options.recover)) {
    return recovering_motion(arm, *start, route, options, budget);
  }
  return planned_or_suggestions(arm, from, route, options, budget);
}

PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options) {
  check_motion_options(options);
  std::vector<Pose> poses = checked_waypoints(waypoints);
  poses.insert(poses.begin(), forward_kinematics(arm, checked_start(arm, start, options)));
  return move_along(arm, start, route_of(lines_through(poses), PathKind::line), options);
}

PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::initializer_list<Pose> waypoints, const PathMotionOptions& options) {
  return move_in_lines(arm, start, std::span<const Pose>(waypoints.begin(), waypoints.size()),
                       options);
}

PathMotion move_in_lines(const Arm& arm, std::initializer_list<double> start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options) {
  const auto size = static_cast<Eigen::Index>(start.size());
  const Configuration q = Eigen::Map<const Configuration>(start.begin(), size);
  return move_in_lines(arm, q, waypoints, options);
}

PathMotion move_in_lines(const Arm& arm, std::initializer_list<double> start,
                         std::initializer_list<Pose> waypoints, const PathMotionOptions& options) {
  return move_in_lines(arm, start, std::span<const Pose>(waypoints.begin(), waypoints.size()),
                       options);
}

PathMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const PathMotionOptions& options) {
  check_motion_options(options);
  return move_along(arm, std::nullopt, route_of(lines_through(poses), PathKind::line), options);
}

PathMotion move_in_lines(const Arm& arm, std::initializer_list<Pose> poses,
                         const PathMotionOptions& options) {
  return move_in_lines(arm, std::span<const Pose>(poses.begin(), poses.size()), options);
}

std::ostream& operator<<(std::ostream& out, const PathMotion& motion) {
  print_motion(out, motion);
  return motion ? print_assumed(print_bound(out << ", ", motion.deviation.bound), motion.limits)
                : out;
}

}  // namespace beeline
