#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/pose_tolerance.h>
#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/internal/self_motion_dimension.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {
namespace {

/// Solves for the arm with the locked coordinate fixed, which the thread keeps.
InverseResult solve_with_lock(SolverState& state, const Pose& world_T_tool,
                              const ConfigurationRef& seed, FailureDetail detail,
                              BudgetMeter& budget) {
  check_lock(state, seed);
  const int k = *state.options.lock;
  const double value = seed[k];
  InverseOptions options = state.options;
  options.lock.reset();
  options.seed.reset();
  options.task = state.task;
  if (options.weights) options.weights = without(*options.weights, k);
  const KeptByThread<LockedArm> locked(state.arm, {k, value});
  SolverState remaining(locked->arm, options);
  remaining.removed_coordinate = k;
  InverseResult result = solve(remaining, world_T_tool, without(seed, k), detail, budget);
  for (Configuration& q : result.solutions) q = with(q, k, value);
  if (result.nearest) {
    result.nearest->q = with(result.nearest->q, k, value);
    if (result.nearest->blocking >= k) ++result.nearest->blocking;
  }
  return result;
}

/// Whether the arm can move from the solution q with the tool at rest: a step in a direction that
/// does not move the tool leads to another solution.
bool has_self_motion(const Request& request, const Configuration& q) {
  constexpr double rounding = 1e-8;  // relative rounding of the singular values of a solution
  constexpr double length = 0.1;     // length of the step, radians or metres
  if (!nearly_singular(request, q, rounding)) return false;
  const Eigen::JacobiSVD<Eigen::MatrixXd> full(task_jacobian(request.arm, q, request.task),
                                               Eigen::ComputeFullV);
  const Configuration moved = q + length * full.matrixV().rightCols<1>();
  const NumericalResult back =
      levenberg_marquardt(request.arm, request.goal, request.task, no_bounds(request.arm), moved,
                          {.tolerance = request.tolerance});
  return back.converged && (back.q - q).norm() > length / 2;
}

/// Adds the Redundancy::any solution, so that the optimum is never worse than it.
void add_any_solution(SolverState& state, Request request, StageResult& found) {
  request.quick = true;
  request.redundancy = Redundancy::any;
  StageResult any;
  const bool usable = run_quick_stages(state, request, any) && !any.solutions->empty();
  if (usable) found.solutions->add() = *any.solutions->begin();
}

/// Whether the last search came so near that the searches of diagnose() may find a solution. Every
/// caller must get that solution.
bool nearly_solved(SolverState& state) {
  constexpr double near = 1e-3;  // metres and radians
  if (state.iterations() == 0) return false;
  const Deviation& error = state.search().nearest.error;
  return std::max(error.position, error.orientation) < near;
}

/// Sets what `detail` asks for in a result without solutions, or finds one.
void set_failure(SolverState& state, const Request& request, FailureDetail detail,
                 StageResult& found) {
  const bool nearly = nearly_solved(state);
  if (detail == FailureDetail::none && !nearly) return;
  std::optional<InverseStatus> status;
  if (detail == FailureDetail::status && !nearly)
    status = status_without_nearest(state, request, found.unconstrained);
  if (status) {
    set_unexplained(request, *status, found);
  } else {
    diagnose(state, request, found);
  }
}

/// Whether run_quick_stages() has searched for a solution with many restarts. The remaining
/// restarts find few more solutions, and take longer than a solution within options.pose_tolerance.
bool searched_quickly(const SolverState& state, const Request& request) {
  return !request.options.all && !(state.family && request.finitely_many());
}

/// Sets the status and reason of solutions that the budget ended the search for, unless the only
/// requested one was found.
void set_incomplete(const Request& request, bool optimised, InverseResult& result) {
  const Ending ending = request.budget.ending();
  if (ending == Ending::complete || !(request.options.all || optimised)) return;
  result.complete = result.branches_complete = false;
  set_ended(request.options.all ? ReasonCode::ended_before_all_solutions
                                : ReasonCode::ended_before_best_solution,
            ending, result);
  if (request.options.all) result.reason.set(ReasonField::count, result.solutions.size());
}

/// Whether each solution has infinitely many equivalents, of which all were requested and one of
/// each is given: a joint without a limit has one in every turn.
bool has_endless_turns(const Request& request) {
  if (!request.options.every_turn) return false;
  for (int k = 0; k < request.arm.dof(); ++k) {
    const bool limited =
        std::isfinite(request.bounds.lower[k]) && std::isfinite(request.bounds.upper[k]);
    if (request.arm.periodic(k) && !limited) return true;
  }
  return false;
}

/// Completes a result that has solutions.
void complete(const Request& request, StageResult& found) {
  InverseResult& result = found.result;
  const UnconstrainedResult& evidence = found.unconstrained;
  const bool all = request.options.all, nearest = result.singular;
  if (all && request.finitely_many() && !result.singular) {
    result.singular = std::any_of(
        found.solutions->begin(), found.solutions->end(), [&](const Solution& solution) {
          return !solution.regular && has_self_motion(request, solution.q);
        });
  }
  const bool finitely_many = !result.singular && !has_endless_turns(request);
  result.complete = all && evidence.complete && finitely_many;
  result.branches_complete =
      all && evidence.branches_complete && (evidence.continuum || !result.singular);
  set_solved(request, found);
  if (result.singular) {
    result.reason = {ReasonCode::self_motion,
                     {{ReasonField::arm, request.arm.name()},
                      {ReasonField::branches_complete, result.branches_complete},
                      {ReasonField::nearest_to_seed, nearest}}};
  }
  if (all && (result.singular || !request.finitely_many())) {
    result.self_motion_dimension =
        std::max(self_motion_dimension(request.arm, request.task, request.goal, result.solutions),
                 result.singular ? 1 : 0);
  }
}

/// The request, whose seed is in `wrapped` if it is far from zero.
Request request_of(const SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
                   BudgetMeter& budget, Configuration& wrapped) {
  check_configuration(state.arm, seed);
  if (seed.cwiseAbs().maxCoeff() <= farthest_seed) {
    return make_request(state, world_T_tool, seed, budget);
  }
  wrapped = seed;
  wrap_unlimited_angles(state.arm, state.bounds, farthest_seed, wrapped);
  return make_request(state, world_T_tool, wrapped, budget);
}

/// Whether the residual of a closed form is the error of its solutions, to the tolerance. An arm
/// whose description rounds angles has axes up to 1e-9 from those that the closed form assumes.
bool residual_is_error(const SolverState& state, double tolerance) {
  constexpr double margin = 10;
  return !state.pieper || margin * (*state.pieper)->error <= tolerance;
}

/// Whether the request of this seed may go to run_quick_stages(): a locked joint keeps a value that
/// request_of() would wrap.
bool keeps_locked_value(const SolverState& state, const ConfigurationRef& seed) {
  return !state.options.lock || seed.cwiseAbs().maxCoeff() <= farthest_seed;
}

/// The result of run_quick_stages(), or nothing if it does not suffice.
std::optional<InverseResult> solve_quickly(SolverState& state, const Pose& world_T_tool,
                                           const ConfigurationRef& seed, FailureDetail detail,
                                           BudgetMeter& budget) {
  Configuration wrapped;
  Request request = request_of(state, world_T_tool, seed, budget, wrapped);
  if (!keeps_locked_value(state, seed)) return {};
  request.quick = true;
  StageResult found;
  if (!run_quick_stages(state, request, found)) return {};
  if (found.solutions->empty()) {
    if (detail != FailureDetail::status || request.options.all) return {};
    const auto status = status_without_nearest(state, request, found.unconstrained);
    if (!status) return {};
    set_unexplained(request, *status, found);
  } else {
    complete(request, found);
  }
  if (found.result.method.empty()) found.result.method = method_name(state);
  return std::move(found.result);
}

}  // namespace

InverseResult solve(SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
                    FailureDetail detail, BudgetMeter& budget) {
  if (auto found = solve_quickly(state, world_T_tool, seed, detail, budget)) {
    return std::move(*found);
  }
  return solve_thoroughly(state, world_T_tool, seed, detail, budget);
}

int solve_into(SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
               BudgetMeter& budget, Eigen::Ref<Eigen::MatrixXd> solutions) {
  Eigen::Index count = 0;
  const auto write = [&](const Configuration& q) {
    if (count == solutions.cols()) return;
    std::copy_n(q.data(), q.size(), solutions.col(count++).data());
  };
  {
    Configuration wrapped;
    Request request = request_of(state, world_T_tool, seed, budget, wrapped);
    request.quick = true;
    request.skips_forward_check = residual_is_error(state, request.tolerance);
    StageResult found;
    if (keeps_locked_value(state, seed) && run_quick_stages(state, request, found)) {
      sort_solutions(request, *found.solutions);
      for (const Solution& each : *found.solutions) write(each.q);
      return static_cast<int>(count);
    }
    const bool may_be_skipped = !state.options.pose_tolerance && !state.options.lock;
    if (may_be_skipped && is_out_of_reach_within_bounds(state, request)) return 0;
  }
  for (const Configuration& q :
       solve_thoroughly(state, world_T_tool, seed, FailureDetail::none, budget).solutions) {
    write(q);
  }
  return static_cast<int>(count);
}

InverseResult solve_thoroughly(SolverState& state, const Pose& world_T_tool,
                               const ConfigurationRef& seed, FailureDetail detail,
                               BudgetMeter& budget) {
  if (state.options.lock) return solve_with_lock(state, world_T_tool, seed, detail, budget);
  Configuration wrapped;
  const Request request = request_of(state, world_T_tool, seed, budget, wrapped);
  state.reset_search();
  const bool tolerant = state.options.pose_tolerance.has_value();
  const bool searched = searched_quickly(state, request);
  if (tolerant && searched) {
    if (auto near = solve_within_tolerance(state, request)) return *near;
  }
  StageResult found;
  InverseResult& result = found.result;
  run_stages(state, request, found);
  if (tolerant && !searched && found.solutions->empty()) {
    if (auto near = solve_within_tolerance(state, request)) return *near;
  }
  if (result.method.empty()) result.method = method_name(state);
  if (found.solutions->empty()) set_failure(state, request, detail, found);
  if (found.solutions->empty()) {
    if (tolerant) result.reason.set(ReasonField::within_pose_tolerance, true);
    return std::move(result);
  }
  const bool optimised = request.arm.dof() > request.task.size() && !request.options.all &&
                         request.redundancy != Redundancy::any;
  if (optimised) {
    add_any_solution(state, request, found);
    optimise_redundancy(request, found);
  }
  complete(request, found);
  set_incomplete(request, optimised, result);
  return std::move(result);
}

}  // namespace beeline::internal
