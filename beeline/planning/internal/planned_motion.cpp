#include <algorithm>
#include <limits>
#include <utility>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/verify.h>
#include <beeline/planning/internal/inset_limits.h>
#include <beeline/planning/internal/motion_proof.h>
#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/timed_plan.h>
#include <beeline/planning/internal/track_branch.h>
#include <beeline/trajectory/internal/given_duration.h>

namespace beeline::internal {
namespace {

// Of the tolerance, for the joint path between samples.
constexpr double interpolated_fraction = 0.01;

// Samples of each segment of the plan that the joint path passes through: with few it is smooth,
// with many it stays near the plan, as next to limits.
constexpr std::size_t few_samples = 32, many_samples = 128;

/// Sets the status and reason of a motion that the budget ended after its branch was planned.
void set_ended_after_plan(Ending ending, PathMotion& motion) {
  motion.status = status_of<MotionStatus>(ending);
  motion.reason = ended_reason(ReasonCode::ended_before_timing, ending);
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

/// Adds the rate and the speed at which the motion is proved, if there are any, to the reason why
/// it is not proved at the rate asked for.
void add_other_rates(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                     std::size_t samples, const PathMotionOptions& options, BudgetMeter& budget,
                     PlanTiming& timing, PathMotion& motion) {
  motion.reason.set(ReasonField::proof_rate, options.rate);
  const double rate = proved_rate(arm, route, task, options, budget, timing);
  if (rate > 0) motion.reason.set(ReasonField::proved_rate, rate);
  const double speed = proved_speed(arm, route, plan, task, samples, options, budget);
  if (speed > 0) motion.reason.set(ReasonField::proved_speed, speed);
}

/// The largest deviation as a multiple of the tolerance.
double tolerances_of(const Deviation& bound, const PathMotionOptions& options) {
  return std::max(bound.position / options.tolerance,
                  bound.orientation / options.orientation_tolerance);
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
  // With more samples the bound falls by a multiple of this, unless the joint path itself leaves
  // the tool path.
  constexpr double falls_by = 0.5;
  double excess = std::numeric_limits<double>::infinity();
  for (int round = 0; round < max_rounds && !budget.ended(); ++round) {
    motion.status = MotionStatus::reached;
    motion.reason = {};
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
    const double before = std::exchange(excess, tolerances_of(motion.deviation.bound, options));
    if (round > 2 && excess > 1 && excess > falls_by * before) break;
    const std::vector<int> times = divisions(motion.deviation, faulty, options);
    if (times.empty()) {
      motion.status = MotionStatus::too_many_samples;
      motion.reason.set(ReasonField::more_samples, static_cast<std::size_t>(options.max_samples));
      break;
    }
    timing.divide(times);
  }
  if (motion.status == MotionStatus::not_proved && options.rate > 0) {
    add_other_rates(arm, route, plan, task, samples, options, budget, timing, motion);
  }
  if (!budget.complete()) set_ended_after_plan(budget.ending(), motion);
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
    if (budget.ended()) return set_ended_after_plan(budget.ending(), motion);
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
  if (!budget.complete()) set_ended_after_plan(budget.ending(), motion);
}

/// Times and proves a plan.
PathMotion timed_and_proved(const Arm& arm, const std::optional<Configuration>& start,
                            const Route& route, const Branch& plan, const BranchOptions& planning,
                            const PathMotionOptions& options, BudgetMeter& budget) {
  PathMotion motion = timed(arm, route, plan, planning.task, few_samples, options, budget);
  if (plan && motion.status == MotionStatus::outside_limits) {
    retry_inside_limits(arm, start, route, planning, options, budget, motion);
  }
  motion.path_parameter = plan.path_parameter;
  return motion;
}

/// Times and proves the other complete branches where the best one is not proved, as at a
/// singularity that it passes nearest. Replaces `motion` by the first that is proved.
void try_other_branches(const Arm& arm, const Route& route, const BranchOptions& planning,
                        const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion) {
  constexpr std::size_t max_others = 3;
  BranchOptions all = planning;
  all.reasons = BranchOptions::Reasons::none;
  const std::vector<Branch> branches = track_branches(arm, route.path, all);
  for (std::size_t i = 1; i < branches.size() && i <= max_others; ++i) {
    if (!branches[i] || budget.ended()) break;
    PathMotion other = timed(arm, route, branches[i], planning.task, few_samples, options, budget);
    if (!other) continue;
    motion = std::move(other);
    motion.path_parameter = branches[i].path_parameter;
    return;
  }
}

}  // namespace

Deviation part_of_tolerance(const PathMotionOptions& options, double fraction) {
  return {fraction * options.tolerance, fraction * options.orientation_tolerance};
}

PathMotion planned_motion(const Arm& arm, const std::optional<Configuration>& start,
                          const Route& route, const BranchOptions& planning,
                          const PathMotionOptions& options, BudgetMeter& budget) {
  const Branch plan = plan_path(arm, start, route.path, planning);
  PathMotion motion = timed_and_proved(arm, start, route, plan, planning, options, budget);
  const bool redundant = arm.dof() > planning.task.size();
  const bool unproved = plan && motion.status == MotionStatus::not_proved;
  if (!start && !redundant && unproved && options.rate == 0 && budget.complete()) {
    try_other_branches(arm, route, planning, options, budget, motion);
  }
  return motion;
}

void keep_duration(const Arm& arm, const Route& route, const Task& task,
                   const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion) {
  motion.reason = set_duration(motion.trajectory, *options.duration);
  if (motion.reason) {
    motion.status = MotionStatus::outside_limits;
    return;
  }
  prove(arm, route, task, options, budget, motion);
  if (!budget.complete()) set_ended_after_plan(budget.ending(), motion);
}

}  // namespace beeline::internal
