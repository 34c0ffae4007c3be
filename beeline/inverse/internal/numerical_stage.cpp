#include <algorithm>
#include <bit>

#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// Calls multi_start() and adds its solutions; with `all`, uses all restarts.
void search(SolverState& state, const Request& request, const Search& from, int restarts, bool all,
            InverseResult& result) {
  Configuration start = request.seed;
  wrap_unlimited_angles(request.arm, from.problem.bounds, 0, start);
  PostureIndex known;
  MultiStartOptions options{.tolerance = request.tolerance,
                            .max_iterations = request.options.max_iterations,
                            .max_restarts = restarts,
                            .all = all,
                            .random_seed = request.options.random_seed,
                            .budget = request.budget};
  // There may be very many solutions, and the budget must also end their storage.
  if (all) {
    options.found = [&](const Configuration& q) { add_solution(request, q, result, &known); };
  }
  const SearchResult& found = state.search();
  multi_start(from, request.goal, start, options, state.buffers(), state.search());
  result.iterations += found.iterations;
  result.restarts += found.restarts;
  if (all) return;
  for (const Configuration& q : found.solutions) add_solution(request, q, result);
}

/// Runs Levenberg-Marquardt within limits from one configuration and adds its solution.
void solve_from(const Request& request, const Configuration& start, InverseResult& result) {
  const NumericalResult run =
      levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, start,
                          {.tolerance = request.tolerance,
                           .max_iterations = request.options.max_iterations,
                           .budget = request.budget});
  result.iterations += run.iterations;
  if (run.converged) add_solution(request, run.q, result);
}

/// Steps the lanes that are started until one converges. Returns that lane, or -1.
int first_to_converge(SolverState& state, const NumericalProblem& problem, const Pose& goal,
                      double tolerance) {
  LevenbergMarquardtLanes& lanes = state.buffers().lanes;
  const int max_iterations = state.options.max_iterations;
  while (lanes.active != 0 && lanes.converged == 0) {
    run_lanes(problem, goal,
              {.tolerance = tolerance, .max_iterations = max_iterations, .first_is_enough = true},
              max_iterations, lanes);
  }
  return lanes.converged != 0 ? std::countr_zero(lanes.converged) : -1;
}

/// Searches without limits for a posture that has another representative within them, or that is a
/// start from which Levenberg-Marquardt converges to a solution within them.
void search_without_limits(SolverState& state, const Request& request, StageResult& found) {
  const Kept<NumericalProblem> unlimited(request.arm, NumericalProblem::Key{request.task, true});
  const Search without_limits{request.arm, *unlimited, seeds_for(state, true, *unlimited)};
  // More restarts find more postures, but most requests in this stage have no solution.
  constexpr int max_restarts_without_limits = 100;
  search(state, request, without_limits,
         std::min(request.options.max_restarts, max_restarts_without_limits), true, found.result);
  const std::vector<Configuration> postures = state.search().solutions;
  const NumericalProblem& problem = search_within_bounds(state).problem;
  for (const Configuration& q : postures) found.unconstrained.consider(request, q);
  for (std::size_t first = 0; first < postures.size(); first += solver_lane_count) {
    if (!found.result.solutions.empty() || request.budget.ended()) break;
    LevenbergMarquardtLanes& lanes = state.buffers().lanes;
    lanes.active = lanes.converged = 0;
    const std::size_t end = std::min(first + solver_lane_count, postures.size());
    for (std::size_t i = first; i < end; ++i) {
      const Configuration nearest =
          nearest_representative(request.arm, postures[i], request.seed, request.bounds);
      start_lane(problem, nearest.data(), static_cast<int>(i - first), lanes);
    }
    const int lane = first_to_converge(state, problem, request.goal, request.tolerance);
    if (lane < 0) continue;
    Configuration q(request.arm.dof());
    lane_configuration(problem, lanes, lane, q.data());
    add_solution(request, q, found.result);
  }
}

}  // namespace

bool search_fast_path(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                      BudgetMeter& budget, Eigen::Ref<Eigen::MatrixXd> solutions) {
  // This solves nearly all poses that have a solution. For the others the numerical stage begins
  // anew.
  constexpr int few_restarts = 64;
  multi_start(search_within_bounds(state), goal, seed,
              {.tolerance = state.options.tolerance,
               .max_iterations = state.options.max_iterations,
               .max_restarts = std::min(state.options.max_restarts, few_restarts),
               .continue_nearest = false,
               .random_seed = state.options.random_seed,
               .budget = budget},
              state.buffers(), state.search());
  if (state.search().solutions.empty()) return false;
  solutions.col(0) = state.search().solutions.front();
  return true;
}

bool search_from_seed(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                      BudgetMeter& budget, Eigen::Ref<Configuration> q) {
  const bool converged = search_from_start(search_within_bounds(state), goal, seed,
                                           {.tolerance = state.options.tolerance,
                                            .max_iterations = state.options.max_iterations,
                                            .budget = budget},
                                           state.buffers(), state.search());
  if (converged) q = state.search().nearest.q;
  return converged;
}

bool solve_from_outside(SolverState& state, const Pose& goal, const LeastOutside& outside,
                        double tolerance, Eigen::Ref<Configuration> q) {
  const NumericalProblem& problem = search_within_bounds(state).problem;
  LevenbergMarquardtLanes& lanes = state.buffers().lanes;
  lanes.active = lanes.converged = 0;
  for (int i = 0; i < outside.count; ++i) start_lane(problem, outside.q[i], i, lanes);
  const int lane = first_to_converge(state, problem, goal, tolerance);
  if (lane >= 0) lane_configuration(problem, lanes, lane, q.data());
  return lane >= 0;
}

void solve_numerical(SolverState& state, const Request& request, StageResult& found) {
  InverseResult& result = found.result;
  const bool first = result.solutions.empty();
  // If one solution is requested, the branch of the seed is tried first.
  if (!request.options.all) solve_from(request, request.seed, result);
  if (request.options.all || result.solutions.empty()) {
    search(state, request, search_within_bounds(state), request.options.max_restarts,
           request.options.all, result);
    if (result.solutions.empty() && any_finite(request.bounds) && !found.unconstrained.complete &&
        !request.budget.ended()) {
      search_without_limits(state, request, found);
    }
  }
  if (first && !result.solutions.empty()) result.method = "numerical";
}

}  // namespace beeline::internal
