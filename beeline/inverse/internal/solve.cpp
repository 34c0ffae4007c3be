#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/pose_tolerance.h>
#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/internal/self_motion_dimension.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/solve_fast_path.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// Solves for the arm with the locked coordinate fixed, which the thread keeps.
InverseResult solve_with_lock(SolverState& state, const Pose& world_T_tool,
                              const Configuration& seed, FailureDetail detail,
                              BudgetMeter& budget) {
  check_configuration(state.arm, seed);
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
  const Eigen::MatrixXd j = task_jacobian(request.arm, q, request.task);
  if (j.rows() == 6 && j.cols() == 6) {
    // The least singular value is at least |det| / norm^5; the determinant takes a tenth of the
    // time.
    const double determinant = Eigen::Matrix<double, 6, 6>(j).determinant();
    if (std::abs(determinant) > rounding * std::pow(j.squaredNorm(), 3)) return false;
  }
  const SixRowSvd svd = six_row_svd(j);
  if (svd.singular_values[q.size() - 1] > rounding * svd.singular_values[0]) return false;
  const Eigen::JacobiSVD<Eigen::MatrixXd> full(j, Eigen::ComputeFullV);
  const Configuration moved = q + length * full.matrixV().rightCols<1>();
  const NumericalResult back =
      levenberg_marquardt(request.arm, request.goal, request.task, no_bounds(request.arm), moved,
                          {.tolerance = request.tolerance});
  return back.converged && (back.q - q).norm() > length / 2;
}

/// Adds the Redundancy::any solution, so that the optimum is never worse than it.
void add_any_solution(SolverState& state, const Request& request, InverseResult& result) {
  const Redundancy requested = std::exchange(state.redundancy, Redundancy::any);
  Configuration q(request.arm.dof());
  const std::optional<FastSolutions> found =
      solve_fast_path(state, request.goal, request.seed, request.budget, q);
  state.redundancy = requested;
  if (found && found->count == 1 && within(request.bounds, q) &&
      error_at(request, q) <= request.tolerance) {
    result.solutions.push_back(q);
  }
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
void set_failure(SolverState& state, const Request& request, const UnconstrainedResult& evidence,
                 FailureDetail detail, InverseResult& result) {
  const bool nearly = nearly_solved(state);
  if (detail == FailureDetail::none && !nearly) return;
  std::optional<InverseStatus> status;
  if (detail == FailureDetail::status && !nearly) {
    status = status_without_nearest(state, request, evidence);
  }
  if (status) {
    set_unexplained(request, evidence, *status, result);
  } else {
    diagnose(state, request, evidence, result);
  }
}

/// Whether solve_fast_path() has searched for a solution with many restarts. The remaining restarts
/// find few more solutions, and take longer than a solution within options.pose_tolerance.
bool searched_fast(const SolverState& state) {
  const bool finitely_many = state.arm.dof() <= state.task.size();
  return !state.options.all && !(state.family && finitely_many);
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

}  // namespace

InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    FailureDetail detail, BudgetMeter& budget) {
  if (state.options.lock) return solve_with_lock(state, world_T_tool, seed, detail, budget);
  check_configuration(state.arm, seed);
  Configuration wrapped = seed;
  wrap_unlimited_angles(state.arm, state.bounds, farthest_seed, wrapped);
  const Request request = make_request(state, world_T_tool, wrapped, budget);
  state.reset_search();
  const bool tolerant = state.options.pose_tolerance.has_value();
  const bool searched = searched_fast(state);
  if (tolerant && searched) {
    if (auto near = solve_within_tolerance(state, request)) return *near;
  }
  auto [result, unconstrained] = run_stages(state, request);
  if (tolerant && !searched && result.solutions.empty()) {
    if (auto near = solve_within_tolerance(state, request)) return *near;
  }
  if (result.solutions.empty()) set_failure(state, request, unconstrained, detail, result);
  if (result.solutions.empty()) {
    if (state.options.pose_tolerance) result.reason.set(ReasonField::within_pose_tolerance, true);
    return result;
  }
  const bool redundant = request.arm.dof() > request.task.size() && !request.options.all;
  const bool optimised = redundant && request.options.redundancy != Redundancy::any;
  if (optimised) {
    add_any_solution(state, request, result);
    optimise_redundancy(request, result);
  }
  const bool finitely_many = request.arm.dof() <= request.task.size();
  const bool nearest = result.singular;
  if (request.options.all && finitely_many && !result.singular) {
    result.singular =
        std::any_of(result.solutions.begin(), result.solutions.end(),
                    [&request](const Configuration& q) { return has_self_motion(request, q); });
  }
  result.complete = request.options.all && unconstrained.complete && !result.singular;
  result.branches_complete = request.options.all && unconstrained.branches_complete &&
                             (unconstrained.continuum || !result.singular);
  finish(request, result);
  if (result.singular) {
    result.reason = {ReasonCode::self_motion,
                     {{ReasonField::arm, request.arm.name()},
                      {ReasonField::branches_complete, result.branches_complete},
                      {ReasonField::nearest_to_seed, nearest}}};
  }
  if (request.options.all && (result.singular || !finitely_many)) {
    result.self_motion_dimension =
        std::max(self_motion_dimension(request.arm, request.task, request.goal, result.solutions),
                 result.singular ? 1 : 0);
  }
  set_incomplete(request, optimised, result);
  return result;
}

}  // namespace beeline::internal
