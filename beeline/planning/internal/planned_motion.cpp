#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/planning/internal/branch_timing.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/track_branch.h>
#include <beeline/timing/internal/possible_rate.h>
#include <beeline/trajectory/internal/given_duration.h>

namespace beeline::internal {
namespace {

// Samples of each segment of the plan that the joint path passes through: with few samples it is
// smooth, with many it remains near the plan, which is needed next to limits.
constexpr std::size_t few_samples = 32, many_samples = 128;

/// The larger part of a deviation, as a multiple of the tolerance.
double tolerances_of(const Deviation& bound, const MotionRequest& request) {
  return std::max(bound.position / request.proof.tolerance,
                  bound.orientation / request.proof.orientation_tolerance);
}

/// Proves the finished motion by verify(), as a check of its file does; refuses one that is not
/// proved. Its deviation then becomes the deviation along the whole path, even if verify() ended
/// earlier. Returns the interval between samples where it found the fault.
std::size_t prove(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion) {
  motion.path = request.route.path;
  motion.arrivals = arrivals(motion.path_parameters);
  VerifyOptions options = request.proof;
  options.budget = budget.part();
  Verification proof = verify(request.arm, motion.trajectory, request.route, options);
  motion.deviation = std::move(proof.deviation);
  if (proof.ending != Ending::complete) return 0;
  motion.limits = limit_usage(request.arm, motion.trajectory, budget.part());
  if (motion.limits.ending != Ending::complete || proof) return 0;
  motion.deviation = path_deviation(request.arm, motion.trajectory, motion.path_parameters,
                                    request.route.path, request.task(), budget.part());
  const Deviation& bound = motion.deviation.bound;
  motion.status = MotionStatus::not_proved;
  motion.reason = within(bound, request.tolerance())
                      ? std::move(proof.reason)
                      : deviation_reason(ReasonCode::path_not_proved, bound);
  return std::min(proof.sample, motion.trajectory.size() - 2);
}

/// Returns the number of parts into which each interval between samples must be divided so that its
/// deviation is proved. The bound falls with the second power of this number for linear joints,
/// with the sixth or the fourth for others. The interval `faulty` is halved at least. Empty if that
/// would exceed max_samples.
std::vector<int> divisions(const PathDeviation& deviation, std::size_t faulty,
                           const MotionRequest& request) {
  constexpr double most = 8;  // at once
  const double power = request.timing.interpolation == Interpolation::linear ? 0.5 : 0.25;
  std::vector<int> times;
  int all = 0;
  for (const Deviation& bound : deviation.interval_bounds) {
    const double excess = tolerances_of(bound, request);
    times.push_back(
        excess <= 1 ? 1
                    : static_cast<int>(std::ceil(std::min(most, 1.01 * std::pow(excess, power)))));
    if (times.back() < 2 && (excess > 1 || times.size() == faulty + 1)) times.back() = 2;
    all += times.back();
  }
  if (all >= request.timing.max_samples) times.clear();
  return times;
}

/// The same request with another arm.
MotionRequest with_arm(const Arm& arm, const MotionRequest& request) {
  return {arm,           request.start,    request.route, request.branch, request.timing,
          request.proof, request.clearance};
}

void set_branch(const Branch& branch, PathMotion& motion) {
  motion.status = branch.status;
  motion.reason = branch.reason;
  motion.path_parameter = branch.path_parameter;
  motion.limit_margin = branch.limit_margin;
  motion.inverse_condition = branch.inverse_condition;
}

/// Sets the trajectory at a rate, or the status and reason why there is none. Returns whether there
/// is one and the budget has not ended.
bool set_trajectory(BranchTiming& timing, double rate, BudgetMeter& budget, PathMotion& motion) {
  TimedBranch timed = timing.sample(rate);
  motion.status = timed.status;
  motion.reason = std::move(timed.reason);
  motion.trajectory = std::move(timed.trajectory);
  motion.path_parameters = std::move(timed.path_parameters);
  return motion && !budget.ended();
}

/// Returns the status of the motion as it is timed now: `reached` if it is proved.
MotionStatus proved_status(const MotionRequest& request, double rate, BudgetMeter& budget,
                           BranchTiming& timing) {
  PathMotion tried;
  if (set_trajectory(timing, rate, budget, tried)) prove(request, budget, tried);
  return budget.complete() ? tried.status : status_of<MotionStatus>(budget.ending());
}

/// Returns the lowest of the usual rates above the requested one for which the motion is proved; 0
/// if there is none. At some rates there may be no motion, although there is one at a higher rate.
double proved_rate(const MotionRequest& request, BudgetMeter& budget, BranchTiming& timing) {
  for (const double rate : {50, 100, 125, 250, 500, 1000, 2000, 4000, 8000}) {
    if (!(rate > request.timing.rate)) continue;
    const MotionStatus status = proved_status(request, rate, budget, timing);
    if (status == MotionStatus::reached) return rate;
    // A higher rate has more samples.
    if (!budget.complete() || status == MotionStatus::too_many_samples) break;
  }
  return 0;
}

/// Returns the largest of some speed scales for which the motion is proved at the requested rate; 0
/// if there is none. At some speeds there may be no motion, although there is one at a lower speed.
double proved_speed(const MotionRequest& request, const Branch& branch, std::size_t samples,
                    BudgetMeter& budget) {
  for (const double scale : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
    const Arm arm = with_speed_scale(request.arm, scale);
    const MotionRequest slower = with_arm(arm, request);
    BranchTiming timing(slower, branch, samples, budget);
    const MotionStatus status = proved_status(slower, request.timing.rate, budget, timing);
    if (status == MotionStatus::reached) return scale;
    // A slower motion has more samples.
    if (!budget.complete() || status == MotionStatus::too_many_samples) break;
  }
  return 0;
}

/// Times and proves a motion. Without a rate, adds samples where it is not proved.
void time_and_prove(const MotionRequest& request, BudgetMeter& budget, BranchTiming& timing,
                    PathMotion& motion) {
  constexpr int max_rounds = 12;
  // With more samples the bound falls by a multiple of this, unless the joint path itself leaves
  // the tool path.
  constexpr double falls_by = 0.5;
  double excess = std::numeric_limits<double>::infinity();
  for (int round = 0; round < max_rounds && !budget.ended(); ++round) {
    if (!set_trajectory(timing, request.timing.rate, budget, motion)) {
      const auto possible = [&](double rate) {
        return proved_status(request, rate, budget, timing) == MotionStatus::reached;
      };
      set_possible_rate(request.timing, timing.shortest_duration(), possible, motion.reason);
      return;
    }
    const auto fault = first_joint_fault(request.arm, motion.trajectory);
    if (fault && fault->kind == Fault::limits) {
      motion.status = MotionStatus::outside_limits;
      motion.reason = fault->reason;
      return;
    }
    const std::size_t faulty = prove(request, budget, motion);
    if (!budget.complete() || motion || request.timing.rate > 0) return;
    const double before = std::exchange(excess, tolerances_of(motion.deviation.bound, request));
    if (round > 2 && excess > 1 && excess > falls_by * before) return;
    const std::vector<int> times = divisions(motion.deviation, faulty, request);
    if (times.empty()) {
      motion.status = MotionStatus::too_many_samples;
      motion.reason.set(ReasonField::more_samples,
                        static_cast<std::size_t>(request.timing.max_samples));
      return;
    }
    timing.divide(times);
  }
}

/// Returns a branch as a motion with times and its proof, or the reason why there is none. A motion
/// that is not proved at the rate has the rate and the speed with which it would be.
PathMotion timed(const MotionRequest& request, const Branch& branch, std::size_t samples,
                 BudgetMeter& whole) {
  BudgetMeter budget(whole.part(planning_share, 1));
  PathMotion motion;
  set_branch(branch, motion);
  if (!branch) return motion;
  BranchTiming timing(request, branch, samples, budget);
  time_and_prove(request, budget, timing, motion);
  if (motion.status == MotionStatus::not_proved && request.timing.rate > 0) {
    motion.reason.set(ReasonField::proof_rate, request.timing.rate);
    const double rate = proved_rate(request, budget, timing);
    if (rate > 0) motion.reason.set(ReasonField::proved_rate, rate);
    const double speed = proved_speed(request, branch, samples, budget);
    if (speed > 0) motion.reason.set(ReasonField::proved_speed, speed);
  }
  if (!budget.complete()) set_ended(ReasonCode::ended_before_timing, budget.ending(), motion);
  return motion;
}

/// Returns the arm with limits moved inwards by `inset`, except limits that `start` would then
/// violate.
Arm with_inset_limits(const Arm& arm, const std::optional<Configuration>& start, double inset) {
  std::vector<Joint> joints = arm.joints();
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const double width = std::min(inset, 0.05 * (limits.upper - limits.lower));
    Limits& reduced = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
                        return joint.name == arm.joint_of(k).name;
                      })->limits;
    reduced.lower = limits.lower + width;
    reduced.upper = limits.upper - width;
    if (!start) continue;
    reduced.lower = std::min(reduced.lower, (*start)[k]);
    reduced.upper = std::max(reduced.upper, (*start)[k]);
  }
  return {arm.name(), joints, arm.tool(), arm.base(), arm.controller()};
}

/// Plans and times again with other options, because a smooth motion of a joint along its limit may
/// exceed it between samples. Replaces `motion` by the first that does not and is proved, or by one
/// that is not proved at the rate.
void retry_inside_limits(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion) {
  // Inset of the limits, radians or metres, and fraction of the tolerance, smallest change first.
  // The steps of a plan are proportional to the square root of its tolerance.
  constexpr std::pair<double, double> attempts[] = {
      {0, 1}, {1e-4, 1}, {3e-4, 1}, {1e-3, 1}, {1e-2, 1}, {1e-4, 1.0 / 64}, {1e-3, 1.0 / 64}};
  for (const auto& [inset, fraction] : attempts) {
    if (budget.ended()) break;
    BranchOptions again = request.branch;
    again.tolerance.position *= fraction;
    again.tolerance.orientation *= fraction;
    Branch branch = plan_path(with_inset_limits(request.arm, request.start, inset), request.start,
                              request.route.path, again);
    if (branch) measure(request.arm, request.branch, budget, branch);
    PathMotion inside = timed(request, branch, many_samples, budget);
    // Within the limits, but not proved at the rate: the reason names what the user can change.
    const bool proof_fails = inside.status == MotionStatus::not_proved && request.timing.rate > 0;
    if (inside || (branch && proof_fails)) motion = std::move(inside);
    if (motion) return;
  }
  if (!budget.complete()) set_ended(ReasonCode::ended_before_timing, budget.ending(), motion);
}

/// Times and proves the other complete branches where the best one is not proved, as at a
/// singularity that it passes nearest. Replaces `motion` by the first that is proved.
void try_other_branches(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion) {
  constexpr std::size_t max_others = 3;
  BranchOptions all = request.branch;
  all.reasons = BranchOptions::Reasons::none;
  const std::vector<Branch> branches = track_branches(request.arm, request.route.path, all);
  for (std::size_t i = 1; i < branches.size() && i <= max_others && !motion; ++i) {
    if (!branches[i] || budget.ended()) break;
    PathMotion other = timed(request, branches[i], few_samples, budget);
    if (other) motion = std::move(other);
  }
}

/// Marks the reason of a motion whose branch passes near a singularity. There joints move far
/// between samples, and another tolerance does not help.
void mark_near_singular(const Branch& branch, PathMotion& motion) {
  constexpr double near = 0.01;  // inverse condition number
  switch (motion.reason.code) {
    case ReasonCode::path_not_proved:
    case ReasonCode::spline_outside_limits:
    case ReasonCode::too_many_samples:
      if (branch.inverse_condition < near) motion.reason.set(ReasonField::near_singular, true);
      break;
    default:
      break;
  }
}

}  // namespace

PathMotion planned_motion(const MotionRequest& request, BudgetMeter& budget) {
  const Branch branch = plan_path(request.arm, request.start, request.route.path, request.branch);
  PathMotion motion = timed(request, branch, few_samples, budget);
  if (branch && motion.status == MotionStatus::outside_limits) {
    retry_inside_limits(request, budget, motion);
  }
  motion.path_parameter = branch.path_parameter;
  const bool unproved = branch && motion.status == MotionStatus::not_proved;
  if (!request.start && unproved && request.timing.rate == 0 && budget.complete() &&
      !is_redundant(request.arm, request.task())) {
    try_other_branches(request, budget, motion);
  }
  if (branch) mark_near_singular(branch, motion);
  return motion;
}

void keep_duration(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion) {
  motion.reason = set_duration(motion.trajectory, *request.timing.duration);
  if (motion.reason) {
    motion.status = MotionStatus::outside_limits;
    return;
  }
  prove(request, budget, motion);
  if (!budget.complete()) set_ended(ReasonCode::ended_before_timing, budget.ending(), motion);
}

PathMotion planned_motion_in_time(const MotionRequest& request, BudgetMeter& budget) {
  PathMotion motion = planned_motion(request, budget);
  if (motion && request.timing.duration) keep_duration(request, budget, motion);
  return motion;
}

}  // namespace beeline::internal
