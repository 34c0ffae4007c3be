#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/internal/joint_reason.h>

namespace beeline::internal {
namespace {

// Max starts of a search for the nearest pose. Each converges to a local minimum of the error. More
// starts find the global minimum more often, and take longer.
constexpr int max_starts = 64;
// Max joints of an arm for which Newton's method then locates the minimum to rounding. The Hessian
// of a longer chain takes too long.
constexpr int max_refined = 12;

Deviation deviation_at(const Request& request, const Configuration& q) {
  return task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
}

NearestMiss nearest_miss(const Request& request, const Configuration& q) {
  NearestMiss miss;
  miss.q = nearest_representative(request.arm, q, request.seed, request.bounds);
  miss.world_T_tool = forward_kinematics(request.arm, q);
  miss.error = deviation_at(request, q);
  return miss;
}

/// Returns the goal. A goal far beyond the reach is moved towards the arm, so that the error keeps
/// its digits.
Pose goal_within_digits(const Request& request) {
  const Arm::Reach& reach = request.arm.reach();
  constexpr double far = 100;  // multiple of the reach; costs two of sixteen digits
  const Vector3 offset = request.goal.translation() - reach.centre;
  Pose goal = request.goal;
  if (offset.norm() > far * reach.radius) {
    goal.translation() = reach.centre + far * reach.radius * offset.normalized();
  }
  return goal;
}

/// Returns the configuration of least error in the rows of `task`, limits ignored.
Configuration nearest_for(const Request& request, const Task& task, SolverState& state,
                          const Configuration& start) {
  const Kept<NumericalProblem> problem(request.arm, NumericalProblem::Key{task, true});
  const Pose goal = goal_within_digits(request);
  multi_start({request.arm, *problem, seeds_for(state, true, *problem)}, goal, start,
              {.tolerance = request.tolerance,
               .max_iterations = 200,  // towards a minimum above zero it converges linearly
               .max_restarts = max_starts,
               .random_seed = request.options.random_seed,
               .budget = request.budget},
              state.buffers(), state.search());
  const NumericalResult& nearest = state.search().nearest;
  if (nearest.converged || request.arm.dof() > max_refined) return nearest.q;
  return nearest_for_task(request.arm, goal, task, nearest.q);
}

/// Returns the configuration of least orientation error among many at the goal's position.
Configuration nearest_orientation_of_many(const Request& request, const Task& position,
                                          SolverState& state, const Configuration& start) {
  if (deviation_at(request, start).position > request.tolerance) return start;
  const Kept<NumericalProblem> problem(request.arm, NumericalProblem::Key{position, true});
  multi_start({request.arm, *problem, seeds_for(state, true, *problem)}, request.goal, start,
              {.tolerance = request.tolerance,
               .max_restarts = max_starts,
               .all = true,
               .random_seed = request.options.random_seed,
               .budget = request.budget},
              state.buffers(), state.search());
  Configuration best =
      nearest_orientation(request.arm, request.goal, request.task, start, request.budget);
  for (const Configuration& q : state.search().solutions) {
    if (request.budget.ended()) break;
    const Configuration there =
        nearest_orientation(request.arm, request.goal, request.task, q, request.budget);
    if (deviation_at(request, there).orientation < deviation_at(request, best).orientation) {
      best = there;
    }
  }
  return best;
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

/// Returns the status of a request that the budget ended before it had a solution.
void set_ended_before_solution(const Request& request, const Configuration& q,
                               InverseResult& result) {
  set_ended(ReasonCode::ended_before_solution, request.budget.ending(), result);
  set_nearest(request, q, result);
}

/// Fills in the result from a proof of infeasibility.
void set_violation(const Infeasibility& violation, InverseResult& result) {
  result.method = "geometry";
  result.reason = violation.reason;
  result.residual = violation.missing;
}

/// Requires result.nearest.
void set_unreachable(const Request& request, const UnconstrainedResult& evidence,
                     InverseResult& result) {
  result.status = InverseStatus::unreachable;
  result.residual = result.nearest->error.position;
  if (evidence.violation && !evidence.violation->of_orientation) {
    set_violation(*evidence.violation, result);
  } else {
    const bool refined = request.arm.dof() <= max_refined && request.budget.complete();
    result.reason = {ReasonCode::position_unreachable,
                     {{ReasonField::distance, result.residual},
                      {ReasonField::arm, request.arm.name()},
                      {ReasonField::refined, refined},
                      {ReasonField::nearest, result.nearest->world_T_tool.translation()}}};
  }
  if (rather_in_millimetres(request.arm.reach(), request.goal.translation())) {
    result.reason.set(ReasonField::in_millimetres, true);
  }
}

/// Requires result.nearest.
void set_orientation_unreachable(const Request& request, const UnconstrainedResult& evidence,
                                 InverseResult& result) {
  result.status = InverseStatus::orientation_unreachable;
  result.residual = result.nearest->error.orientation;
  if (evidence.violation) return set_violation(*evidence.violation, result);
  const bool has_position = position_part(request.task).size() > 0;
  result.reason = {ReasonCode::orientation_unreachable,
                   {{ReasonField::arm, request.arm.name()},
                    {ReasonField::has_position, has_position},
                    {ReasonField::angle, result.residual}}};
}

/// Completes the result and returns true if q is a solution that the stages missed.
bool accept_if_solution(const Request& request, const Configuration& q, InverseResult& result) {
  if (error_at(request, q) > request.tolerance) return false;
  if (request.options.method == InverseMethod::closed_form) {
    set_not_found(request, q, {ReasonCode::no_closed_form_solution}, result);
    return true;
  }
  add_solution(request, q, result);
  result.method = "numerical";
  if (result.solutions.empty()) {
    const Configuration nearest =
        nearest_representative(request.arm, q, request.seed, request.bounds);
    set_outside_limits(request, nearest, false, result);
  }
  return true;
}

/// Runs all stages again without joint limits, for all solutions, and calls accept_if_solution()
/// with the one that exceeds the limits least.
bool solve_without_limits(const SolverState& limited, const Request& request,
                          InverseResult& result) {
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
  StageResult found = run_stages(state, unlimited);
  if (found.result.solutions.empty()) return false;
  finish(unlimited, found.result);
  UnconstrainedResult evidence;
  for (const Configuration& q : found.result.solutions) evidence.consider(request, q);
  return accept_if_solution(request, *evidence.least_outside, result);
}

/// Returns the configuration with the nearest pose, limits ignored: by position first, then by
/// orientation. If the search finds a solution, completes the result and returns nothing.
std::optional<Configuration> nearest_configuration(SolverState& state, const Request& request,
                                                   InverseResult& result) {
  Configuration q = nearest_for(request, request.task, state, request.seed);
  if (accept_if_solution(request, q, result)) return std::nullopt;
  const Task position = position_part(request.task);
  if (position.size() == 0 || position.size() == request.task.size()) return q;
  q = nearest_for(request, position, state, q);
  q = nearest_orientation_of_many(request, position, state, q);
  if (accept_if_solution(request, q, result)) return std::nullopt;
  return q;
}

/// Chooses the status for a request for which no solution is known, with or without limits.
void set_nearest(const Request& request, const UnconstrainedResult& evidence, bool proved,
                 const Configuration& q, InverseResult& result) {
  result.nearest = nearest_miss(request, q);
  const Deviation& error = result.nearest->error;
  // At the boundary of the workspace the error is only determined to the square root of rounding,
  // so a smaller error does not show that the pose is outside.
  constexpr double at_the_edge = 1e-6;  // radians, or a fraction of the arm's size
  const bool has_position = position_part(request.task).size() > 0;
  const bool away =
      error.position > std::max(request.tolerance, at_the_edge * unit_of_length(request.arm));
  if (has_position && (away || (proved && error.position > request.tolerance))) {
    return set_unreachable(request, evidence, result);
  }
  // This is the accuracy of nearest_orientation().
  constexpr double clear = 1e-3;  // radians
  const bool searched =
      (result.restarts >= max_starts || evidence.range_examined) && error.orientation > clear;
  const bool examined = evidence.complete && error.orientation > at_the_edge;
  const bool in_position = error.position <= request.tolerance;
  if (evidence.violation || (in_position && (searched || examined))) {
    return set_orientation_unreachable(request, evidence, result);
  }
  Reason reason{ReasonCode::no_solution_found};
  if (result.iterations > 0) {
    reason.set(ReasonField::starts, static_cast<std::size_t>(result.restarts) + 1);
  }
  set_not_found(request, q, std::move(reason), result);
}

}  // namespace

void diagnose(SolverState& state, const Request& request, const UnconstrainedResult& evidence,
              InverseResult& result) {
  const bool proved = evidence.violation ||
                      out_of_reach(request.arm, request.goal, request.task, request.tolerance);
  const bool outside = evidence.least_outside && evidence.excess > 0;
  if (!request.budget.complete() && !proved && !(outside && evidence.complete)) {
    const Configuration& met = state.search().nearest.q;
    const bool nearer =
        state.iterations() > 0 && error_at(request, met) < error_at(request, request.seed);
    return set_ended_before_solution(request, nearer ? met : request.seed, result);
  }
  if (outside) {
    const bool all_examined = evidence.complete && !evidence.continuum;
    return set_outside_limits(request, *evidence.least_outside, all_examined, result);
  }
  const std::optional<Configuration> nearest = nearest_configuration(state, request, result);
  if (!nearest || (!proved && solve_without_limits(state, request, result))) return;
  if (!request.budget.complete() && !proved)
    return set_ended_before_solution(request, *nearest, result);
  set_nearest(request, evidence, proved, *nearest, result);
}

}  // namespace beeline::internal
