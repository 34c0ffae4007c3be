#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/nearest_search.h>
#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/internal/joint_reason.h>

namespace beeline::internal {
namespace {

// At the boundary of the workspace the error is only determined to the square root of rounding, so
// a smaller error does not show that the pose is outside.
constexpr double at_the_edge = 1e-6;  // radians, or a fraction of the arm's size

NearestMiss nearest_miss(const Request& request, const Configuration& q) {
  NearestMiss miss;
  miss.q = nearest_representative(request.arm, q, request.seed, request.bounds);
  miss.world_T_tool = forward_kinematics(request.arm, q);
  miss.error = deviation_at(request, q);
  return miss;
}

void set_outside_limits(const Request& request, const Configuration& q, bool all_examined,
                        InverseResult& result) {
  result.status = InverseStatus::outside_limits;
  result.nearest = nearest_miss(request, q);
  const Configuration over = (request.bounds.lower - q).cwiseMax(q - request.bounds.upper);
  result.nearest->excess = over.maxCoeff(&result.nearest->blocking);
  result.residual = result.nearest->excess;
  const int k = result.nearest->blocking;
  const bool above = q[k] > request.bounds.upper[k];
  result.reason = joint_reason(all_examined ? ReasonCode::all_solutions_outside_limits
                                            : ReasonCode::solutions_outside_limits,
                               request.arm.joint_of(k));
  result.reason.set(ReasonField::value, q[k]).set(ReasonField::excess, result.residual);
  result.reason.set(ReasonField::is_upper, above);
  result.reason.set(ReasonField::limit, above ? request.bounds.upper[k] : request.bounds.lower[k]);
}

/// Adds the parts of an error that exceed the tolerance.
void add_miss(const Deviation& error, double tolerance, Reason& reason) {
  const bool rotated = error.orientation > tolerance;
  if (!rotated || error.position > tolerance) reason.set(ReasonField::distance, error.position);
  if (rotated) reason.set(ReasonField::angle, error.orientation);
}

/// Sets the nearest miss, at q, with its residual and its part of the reason.
void set_nearest(const Request& request, const Configuration& q, InverseResult& result) {
  result.nearest = nearest_miss(request, q);
  const Deviation& error = result.nearest->error;
  result.residual = std::max(error.position, error.orientation);
  add_miss(error, request.tolerance, result.reason);
}

void set_not_found(const Request& request, const Configuration& q, Reason reason,
                   InverseResult& result) {
  result.status = InverseStatus::not_found;
  result.reason = std::move(reason);
  set_nearest(request, q, result);
}

/// Sets the status of a request that the budget ended before it had a solution.
void set_ended_before_solution(const Request& request, const Configuration& q,
                               InverseResult& result) {
  set_ended(ReasonCode::ended_before_solution, request.budget.ending(), result);
  set_nearest(request, q, result);
}

/// Adds that the arm has fewer joints than a pose has conditions.
void add_conditions(const Request& request, Reason& reason) {
  constexpr int of_position = 3;  // what the advice asks for, at least
  const int n = request.arm.dof();
  if (request.has_lock || request.task.size() < 6 || n < of_position || n >= 6) return;
  reason.set(ReasonField::joints, static_cast<std::size_t>(n))
      .set(ReasonField::conditions, static_cast<std::size_t>(request.task.size()));
}

/// Fills in the result from a proof of infeasibility.
void set_violation(const Infeasibility& violation, InverseResult& result) {
  result.method = "geometry";
  result.reason = violation.reason;
  result.residual = violation.missing;
}

/// The reason has values if result.nearest is known.
void set_unreachable(const Request& request, StageResult& found) {
  const UnconstrainedResult& evidence = found.unconstrained;
  InverseResult& result = found.result;
  if (evidence.violation && !evidence.violation->of_orientation) {
    set_violation(*evidence.violation, result);
  } else {
    result.reason = {ReasonCode::position_unreachable};
    if (result.nearest) result.reason.set(ReasonField::distance, result.nearest->error.position);
    result.reason.set(ReasonField::arm, request.arm.name());
    if (result.nearest) {
      result.residual = result.nearest->error.position;
      const bool refined = request.arm.dof() <= max_refined && request.budget.complete();
      result.reason.set(ReasonField::refined, refined)
          .set(ReasonField::nearest, Vector3(result.nearest->world_T_tool.translation()));
    }
  }
  if (rather_in_millimetres(request.arm.reach(), request.goal.translation())) {
    result.reason.set(ReasonField::in_millimetres, true);
  }
}

/// The reason has values if result.nearest is known.
void set_orientation_unreachable(const Request& request, StageResult& found) {
  InverseResult& result = found.result;
  if (found.unconstrained.violation) return set_violation(*found.unconstrained.violation, result);
  const bool has_position = position_part(request.task).size() > 0;
  result.reason = {
      ReasonCode::orientation_unreachable,
      {{ReasonField::arm, request.arm.name()}, {ReasonField::has_position, has_position}}};
  if (!result.nearest) return;
  result.residual = result.nearest->error.orientation;
  result.reason.set(ReasonField::angle, result.residual);
  add_conditions(request, result.reason);
}

/// Sets the status unreachable, orientation_unreachable or outside_limits, with its reason. The
/// reason of the first two has values if found.result.nearest is known.
void set_negative_status(const Request& request, InverseStatus status, StageResult& found) {
  found.result.status = status;
  if (status == InverseStatus::unreachable) return set_unreachable(request, found);
  if (status == InverseStatus::orientation_unreachable) {
    return set_orientation_unreachable(request, found);
  }
  found.result.reason = {ReasonCode::solutions_outside_limits};
}

/// Completes the result and returns true if q is a solution that the stages missed.
bool accept_if_solution(const Request& request, const Configuration& q, StageResult& found) {
  if (error_at(request, q) > request.tolerance) return false;
  if (request.options.method == InverseMethod::closed_form) {
    set_not_found(request, q, {ReasonCode::no_closed_form_solution}, found.result);
    return true;
  }
  found.result.method = "numerical";
  if (add_solution(request, q, found)) return true;
  const Configuration nearest =
      nearest_representative(request.arm, q, request.seed, request.bounds);
  set_outside_limits(request, nearest, false, found.result);
  return true;
}

/// Runs all stages again without joint limits, for all solutions, and calls accept_if_solution()
/// with the one that exceeds the limits least.
bool solve_without_limits(const SolverState& limited, const Request& request, StageResult& result) {
  if (!any_finite(request.bounds) || request.options.method != InverseMethod::automatic) {
    return false;
  }
  InverseOptions options = request.options;
  options.ignore_limits = options.all = true;
  options.every_turn = false;
  options.task = request.task;
  options.seed.reset();
  // Solutions on a grid of a redundant joint prove nothing; a search takes less time.
  if (!limited.family && request.arm.dof() > 6) options.method = InverseMethod::numerical;
  SolverState state(request.arm, options);
  Configuration seed = request.seed;
  wrap_unlimited_angles(state.arm, state.bounds, farthest_seed, seed);
  const Request unlimited = make_request(state, request.goal, seed, request.budget);
  StageResult found;
  run_stages(state, unlimited, found);
  if (found.solutions->empty()) return false;
  sort_solutions(unlimited, *found.solutions);
  UnconstrainedResult evidence;
  for (const Solution& each : *found.solutions) evidence.consider(request, each.q);
  return accept_if_solution(request, *evidence.least_outside, result);
}

/// Returns the configuration with the nearest pose, limits ignored: by position first, then by
/// orientation. If the search finds a solution, completes the result and returns nothing.
std::optional<Configuration> nearest_configuration(SolverState& state, const Request& request,
                                                   StageResult& found) {
  const auto is_accepted = [&](const Configuration& q) {
    if (!accept_if_solution(request, q, found)) return false;
    found.result.iterations += state.search().iterations;
    found.result.restarts += state.search().restarts;
    return true;
  };
  Configuration q = nearest_for(request, request.task, state, request.seed);
  if (is_accepted(q)) return std::nullopt;
  const Task position = position_part(request.task);
  if (position.size() == 0 || position.size() == request.task.size()) return q;
  q = nearest_for(request, position, state, q);
  q = nearest_orientation_of_many(request, position, state, q);
  if (is_accepted(q)) return std::nullopt;
  return q;
}

/// Whether searches from many starts show that there is no solution. Helical joints have other
/// poses in every turn, and the searches often miss the right turn; so they do far away, where only
/// slides without limits lead.
bool is_searched_by_starts(const Request& request) {
  const Arm& arm = request.arm;
  constexpr double far = 10;  // times the arm's size
  const Arm::Reach& reach = arm.reach();
  const double distance = (request.goal.translation() - reach.centre).norm();
  if (!std::isfinite(reach.radius) && distance > far * unit_of_length(arm)) return false;
  return std::none_of(arm.joints().begin(), arm.joints().end(),
                      [](const Joint& joint) { return kind(joint) == JointKind::helical; });
}

/// Chooses the status for a request for which no solution is known, with or without limits.
void choose_status(const Request& request, bool proved, const Configuration& q,
                   StageResult& found) {
  const UnconstrainedResult& evidence = found.unconstrained;
  InverseResult& result = found.result;
  result.nearest = nearest_miss(request, q);
  const Deviation& error = result.nearest->error;
  const bool has_position = position_part(request.task).size() > 0;
  const bool shown = is_searched_by_starts(request);
  const bool away = shown && error.position > std::max(request.tolerance,
                                                       at_the_edge * unit_of_length(request.arm));
  if (has_position && (away || (proved && error.position > request.tolerance))) {
    return set_negative_status(request, InverseStatus::unreachable, found);
  }
  // This is the accuracy of nearest_orientation().
  constexpr double clear = 1e-3;  // radians
  const bool searched =
      shown && (result.restarts >= max_starts || evidence.range_examined || evidence.far) &&
      error.orientation > clear;
  const bool examined = evidence.complete && error.orientation > at_the_edge;
  const bool in_position = error.position <= request.tolerance;
  if (evidence.violation || (in_position && (searched || examined))) {
    return set_negative_status(request, InverseStatus::orientation_unreachable, found);
  }
  Reason reason{ReasonCode::no_solution_found};
  if (result.iterations > 0) {
    reason.set(ReasonField::starts, static_cast<std::size_t>(result.restarts) + 1);
  }
  add_conditions(request, reason);
  set_not_found(request, q, std::move(reason), result);
}

/// Whether the pose has a solution if limits are ignored, by the values of the redundant joint
/// beyond its limits. Those within were examined and have none. Nothing if that is not clear.
std::optional<bool> is_solved_beyond(const SolverState& state, const Request& request) {
  const PieperSolver& form = state.pieper_solver();
  const int k = *form.locked();
  if (kind(request.arm.joint_of(k)) != JointKind::revolute) return std::nullopt;
  const LockedRange within =
      locked_range(request.arm, request.bounds, request.seed, k, form.size());
  const LockedRange beyond{
      .lower = within.upper, .upper = within.lower + 2 * std::numbers::pi, .seed = within.upper};
  if (beyond.upper <= beyond.lower) return false;
  const double intervals =
      max_range_intervals * (beyond.upper - beyond.lower) / (2 * std::numbers::pi);
  const Bounds& open = state.defaults->no_limits;
  LockedRequest locked{
      form, request,
      form.request(request.seed, request.weights, open.lower, open.upper, request.tolerance),
      beyond};
  LeastOutside outside;
  const ExaminedRange found = examine_range(
      locked, outside, std::clamp(static_cast<int>(std::ceil(intervals)), 2, max_range_intervals));
  if (found.branch.lane < 0) return found.conclusive ? std::optional(false) : std::nullopt;
  Configuration q(request.arm.dof());
  form.configuration(found.branch.found, found.branch.lane, found.branch.value, q.data());
  return error_at(request, q) <= request.tolerance ? std::optional(true) : std::nullopt;
}

/// The status of a pose that has no solution, with or without limits.
std::optional<InverseStatus> status_by_position(SolverState& state, const Request& request) {
  const Task position = position_part(request.task);
  if (!is_searched_by_starts(request)) return std::nullopt;
  if (position.size() == 0 || position.size() == request.task.size()) return std::nullopt;
  const Configuration& q = nearest_of_searches(request, position, state, request.seed);
  if (!request.budget.complete()) return std::nullopt;
  const double error = deviation_at(request, q).position;
  if (error <= request.tolerance) return InverseStatus::orientation_unreachable;
  // A minimum so far from zero is not one of rounding.
  constexpr double far = 1e-3;  // fraction of the arm's size
  if (error > far * unit_of_length(request.arm)) return InverseStatus::unreachable;
  return std::nullopt;
}

}  // namespace

std::optional<InverseStatus> status_without_nearest(SolverState& state, const Request& request,
                                                    const UnconstrainedResult& evidence) {
  if (is_out_of_reach(state, request)) return InverseStatus::unreachable;
  if (evidence.violation) {
    return evidence.violation->of_orientation ? std::nullopt
                                              : std::optional(InverseStatus::unreachable);
  }
  if (evidence.solved_outside) return InverseStatus::outside_limits;
  if (evidence.least_outside || evidence.doubtful || !request.budget.complete())
    return std::nullopt;
  if (evidence.range_examined) {
    const std::optional<bool> solved = is_solved_beyond(state, request);
    if (!solved) return std::nullopt;
    if (*solved) return InverseStatus::outside_limits;
  } else if (evidence.continuum || !(evidence.complete || evidence.far)) {
    return std::nullopt;
  }
  return status_by_position(state, request);
}

void set_unexplained(const Request& request, InverseStatus status, StageResult& found) {
  found.result.residual = std::numeric_limits<double>::quiet_NaN();
  set_negative_status(request, status, found);
}

void diagnose(SolverState& state, const Request& request, StageResult& found) {
  const UnconstrainedResult& evidence = found.unconstrained;
  const bool proved = evidence.violation || is_out_of_reach(state, request);
  const bool outside = evidence.least_outside && evidence.excess > 0;
  if (!request.budget.complete() && !proved && !(outside && evidence.complete)) {
    const Configuration& met = state.search().nearest.q;
    const bool nearer =
        state.iterations() > 0 && error_at(request, met) < error_at(request, request.seed);
    return set_ended_before_solution(request, nearer ? met : Configuration(request.seed),
                                     found.result);
  }
  if (outside) {
    const bool all_examined = evidence.complete && !evidence.continuum;
    return set_outside_limits(request, *evidence.least_outside, all_examined, found.result);
  }
  const std::optional<Configuration> nearest = nearest_configuration(state, request, found);
  if (!nearest || (!proved && solve_without_limits(state, request, found))) return;
  if (!request.budget.complete() && !proved)
    return set_ended_before_solution(request, *nearest, found.result);
  choose_status(request, proved, *nearest, found);
}

}  // namespace beeline::internal
