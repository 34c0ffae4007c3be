#include <algorithm>
#include <limits>
#include <utility>

#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/solve_unblocked.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {
namespace {

constexpr std::size_t all_of_them = std::numeric_limits<std::size_t>::max();
constexpr double same = 1e-6;  // radians or metres

bool equal(const Configuration& a, const Configuration& b) {
  return (a - b).lpNorm<Eigen::Infinity>() < same;
}

/// Keeps what explain() needs. The functions of the caller may not live as long as the result.
void keep_request(const SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
                  InverseResult& result) {
  InverseOptions options = state.options;
  if (!options.seed && !options.redundancy) options.redundancy = Redundancy::any;
  options.seed = seed;
  options.budget = {};
  options.blocked_by = {};
  result.unexplained.emplace(InverseRequest{state.arm, world_T_tool, std::move(options)});
}

/// Moves blocked solutions to result.blocked, until `max_free` others are found.
void separate_blocked(const InverseOptions& options, std::size_t max_free, BudgetMeter& budget,
                      InverseResult& result) {
  std::vector<Configuration> found = std::exchange(result.solutions, {});
  for (Configuration& q : found) {
    if (result.solutions.size() == max_free || budget.ended()) break;
    Reason reason = options.blocked_by(q);
    if (reason) {
      result.blocked.push_back({std::move(q), std::move(reason)});
    } else {
      result.solutions.push_back(std::move(q));
    }
  }
}

/// Sets the status and reason of a result whose solutions were divided.
void set_status(const InverseOptions& options, const BudgetMeter& budget, InverseResult& result) {
  const bool has_free = !result.solutions.empty();
  if (!budget.complete()) {
    result.complete = result.branches_complete = false;
    const bool best = has_free && !options.all;
    set_ended(
        best ? ReasonCode::ended_before_best_solution : ReasonCode::ended_before_all_solutions,
        budget.ending(), result);
    if (!best) result.reason.set(ReasonField::count, result.solutions.size());
    return;
  }
  if (has_free) return;
  // Solutions within the tolerance, beside the exact ones, were not searched.
  if (options.pose_tolerance) result.complete = result.branches_complete = false;
  result.status = InverseStatus::blocked;
  result.reason = {
      result.complete ? ReasonCode::all_solutions_blocked : ReasonCode::solutions_blocked,
      {{ReasonField::count, result.blocked.size()}},
      {result.blocked.front().reason}};
}

/// The coordinate that changes most in the self-motion at q.
int moving_coordinate(const Request& request, const Configuration& q) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(task_jacobian(request.arm, q, request.task),
                                              Eigen::ComputeFullV);
  Eigen::Index k = 0;
  svd.matrixV().rightCols<1>().cwiseAbs().maxCoeff(&k);
  return static_cast<int>(k);
}

/// Adds the solutions with one coordinate locked at the values of a grid over its range, if there
/// are infinitely many and they are not on a grid yet.
void add_along_self_motion(const Request& request, const Configuration& q, InverseResult& result) {
  constexpr int max_restarts = 20;  // for each value
  const int k = moving_coordinate(request, q);
  InverseOptions options = request.options;
  options.lock = k;
  options.every_turn = false;
  options.pose_tolerance.reset();
  options.max_restarts = std::min(options.max_restarts, max_restarts);
  if (options.method == InverseMethod::closed_form) options.method = InverseMethod::automatic;
  SolverState locked(request.arm, options);
  const LockedRange range =
      locked_range(request.arm, request.bounds, request.seed, k, unit_of_length(request.arm));
  for (const double value : grid_values(range, options.grid)) {
    if (request.budget.ended()) return;
    Configuration seed = request.seed;
    seed[k] = value;
    const InverseResult there =
        solve(locked, request.goal, seed, FailureDetail::none, request.budget);
    result.residual = std::max(result.residual, there ? there.residual : 0);
    result.solutions.insert(result.solutions.end(), there.solutions.begin(), there.solutions.end());
  }
}

/// Returns all solutions in the order in which they are preferred, and among them `first`, which
/// is not on the grid of a redundant arm.
InverseResult all_in_order(SolverState& state, const Pose& world_T_tool,
                           const ConfigurationRef& seed, const Configuration& first,
                           BudgetMeter& budget) {
  InverseOptions options = state.options;
  options.all = true;
  SolverState all(state.arm, options);
  InverseResult result = solve(all, world_T_tool, seed, FailureDetail::none, budget);
  std::vector<Configuration>& found = result.solutions;
  const auto is_first = [&](const Configuration& q) { return equal(q, first); };
  if (std::none_of(found.begin(), found.end(), is_first)) found.insert(found.begin(), first);
  const Request request = make_request(all, world_T_tool, seed, budget);
  if (result.self_motion_dimension > 0 && !request.options.lock && !result.grid) {
    add_along_self_motion(request, first, result);
  }
  const bool redundant = request.arm.dof() > request.task.size();
  const auto objective = [&](const Configuration& q) {
    return redundant ? redundancy_objective(request, q) : distance_from_seed(request, q);
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return objective(a) < objective(b); });
  return result;
}

}  // namespace

InverseResult solve_unblocked(SolverState& state, const Pose& world_T_tool,
                              const ConfigurationRef& seed, FailureDetail detail,
                              BudgetMeter& budget) {
  const InverseOptions& options = state.options;
  InverseResult result = solve(state, world_T_tool, seed, detail, budget);
  if (result.solutions.empty() && !result.nearest && detail != FailureDetail::none) {
    keep_request(state, world_T_tool, seed, result);
  }
  if (!options.blocked_by || result.solutions.empty()) return result;
  if (options.all) {
    separate_blocked(options, all_of_them, budget, result);
    set_status(options, budget, result);
    return result;
  }
  const Configuration first = result.solutions.front();
  if (budget.complete() && !options.blocked_by(first)) return result;
  InverseResult all = all_in_order(state, world_T_tool, seed, first, budget);
  all.residual = std::max(all.residual, result.residual);
  all.status = InverseStatus::solved;
  separate_blocked(options, 1, budget, all);
  if (!all.solutions.empty() && equal(all.solutions.front(), first)) {
    all.deviation = std::move(result.deviation);
  }
  set_status(options, budget, all);
  if (!all.solutions.empty()) {
    all.complete = all.branches_complete = false;
    all.self_motion_dimension = 0;
    all.grid.reset();
  }
  return all;
}

}  // namespace beeline::internal
