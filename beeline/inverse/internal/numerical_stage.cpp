#include <algorithm>
#include <bit>

#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/numerical/nearest_on_self_motion.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// Calls multi_start() and adds its solutions; with `all`, uses all restarts.
void search(SolverState& state, const Request& request, const Search& from, int restarts, bool all,
            StageResult& found) {
  MultiStartOptions options{.tolerance = request.tolerance,
                            .max_iterations = request.options.max_iterations,
                            .max_restarts = std::min(request.options.max_restarts, restarts),
                            .all = all,
                            .continue_nearest = !request.quick,
                            .random_seed = request.options.random_seed,
                            .budget = request.budget};
  // There may be very many solutions, and the budget must also end their storage.
  if (all) options.found = [&](const Configuration& q) { add_solution(request, q, found); };
  SearchResult& ended = state.search();
  if (request.quick) {
    multi_start(from, request.goal, request.seed, options, state.buffers(), ended);
  } else {
    Configuration start = request.seed;
    wrap_unlimited_angles(request.arm, from.problem.bounds, 0, start);
    multi_start(from, request.goal, start, options, state.buffers(), ended);
  }
  found.result.iterations += ended.iterations;
  found.result.restarts += ended.restarts;
  if (all) return;
  for (const Configuration& q : ended.solutions) add_solution(request, q, found);
}

/// Runs Levenberg-Marquardt within limits from the seed and adds its solution.
void solve_from_seed(const Request& request, StageResult& found) {
  const NumericalResult run =
      levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, request.seed,
                          {.tolerance = request.tolerance,
                           .max_iterations = request.options.max_iterations,
                           .budget = request.budget});
  found.result.iterations += run.iterations;
  if (run.converged) add_solution(request, run.q, found);
}

/// Steps the lanes that are started until one converges. Returns that lane, or -1.
int first_to_converge(const Request& request, const NumericalProblem& problem,
                      LevenbergMarquardtLanes& lanes) {
  const int max_iterations = request.options.max_iterations;
  while (lanes.active != 0 && lanes.converged == 0) {
    run_lanes(
        problem, request.goal,
        {.tolerance = request.tolerance, .max_iterations = max_iterations, .first_is_enough = true},
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
  search(state, request, without_limits, max_restarts_without_limits, true, found);
  const std::vector<Configuration> postures = state.search().solutions;
  const NumericalProblem& problem = search_within_bounds(state).problem;
  for (const Configuration& q : postures) found.unconstrained.consider(request, q);
  for (std::size_t first = 0; first < postures.size(); first += solver_lane_count) {
    if (!found.solutions->empty() || request.budget.ended()) break;
    LevenbergMarquardtLanes& lanes = state.buffers().lanes;
    lanes.active = lanes.converged = 0;
    const std::size_t end = std::min(first + solver_lane_count, postures.size());
    for (std::size_t i = first; i < end; ++i) {
      const Configuration nearest =
          nearest_representative(request.arm, postures[i], request.seed, request.bounds);
      start_lane(problem, nearest.data(), static_cast<int>(i - first), lanes);
    }
    const int lane = first_to_converge(request, problem, lanes);
    if (lane < 0) continue;
    Configuration q(request.arm.dof());
    lane_configuration(problem, lanes, lane, q.data());
    add_solution(request, q, found);
  }
}

LaneOptions lane_options(const Request& request) {
  return {.tolerance = request.tolerance,
          .max_iterations = request.options.max_iterations,
          .wraps = false};
}

void write_solution(const NumericalProblem& problem, const GaussNewtonState& near,
                    Configuration& q) {
  for (std::size_t k = 0; k < near.q.size(); ++k) {
    q[static_cast<Eigen::Index>(k)] = near.q[k] * problem.coordinates[k].unit;
  }
}

}  // namespace

bool search_from_seed(SolverState& state, const Request& request, Configuration& q) {
  const bool converged = search_from_start(search_within_bounds(state), request.goal, request.seed,
                                           {.tolerance = request.options.tolerance,
                                            .max_iterations = request.options.max_iterations,
                                            .budget = request.budget},
                                           state.buffers(), state.search());
  if (converged) q = state.search().nearest.q;
  return converged;
}

bool solution_from(SolverState& state, const Request& request, const double* start, bool damped,
                   Configuration& q) {
  const NumericalProblem& problem = problem_within_bounds(state);
  if (damped) {
    LevenbergMarquardtLanes& lanes = state.buffers().lanes;
    lanes.active = lanes.converged = 0;
    start_lane(problem, start, 0, lanes);
    if (first_to_converge(request, problem, lanes) < 0) return false;
    lane_configuration(problem, lanes, 0, q.data());
    start = q.data();
  }
  GaussNewtonState& near = state.buffers().near;
  if (!gauss_newton(problem, request.goal, start, lane_options(request), near)) return false;
  write_solution(problem, near, q);
  return true;
}

bool approach_seed(SolverState& state, const Request& request, Configuration& q) {
  const NumericalProblem& problem = problem_within_bounds(state);
  GaussNewtonState& near = state.buffers().near;
  if (!approach_start(problem, request.goal, request.seed.data(), request.weights.data(),
                      lane_options(request), near)) {
    return false;
  }
  write_solution(problem, near, q);
  return true;
}

void approach_seed(SolverState& state, const Request& request, StageResult& found) {
  if (!request.near_seed || found.near_seed) return;
  Configuration& q = found.solutions->candidate;
  q.resize(request.arm.dof());
  for (Solution& each : *found.solutions) {
    if (!solution_from(state, request, each.q.data(), false, q) ||
        !approach_seed(state, request, q)) {
      continue;
    }
    const double error = error_at(request, q);
    const bool nearer = distance_from_seed(request, q) < distance_from_seed(request, each.q);
    if (!nearer || error > request.tolerance) continue;
    each.q = q;  // in its memory
    each.error = error;
    each.regular = false;
  }
}

bool solve_from_outside(SolverState& state, const Request& request, const LeastOutside& outside,
                        Configuration& q) {
  const NumericalProblem& problem = search_within_bounds(state).problem;
  LevenbergMarquardtLanes& lanes = state.buffers().lanes;
  lanes.active = lanes.converged = 0;
  for (int i = 0; i < outside.count; ++i) start_lane(problem, outside.q[i], i, lanes);
  const int lane = first_to_converge(request, problem, lanes);
  if (lane >= 0) lane_configuration(problem, lanes, lane, q.data());
  return lane >= 0;
}

void solve_numerical(SolverState& state, const Request& request, StageResult& found) {
  // Few restarts solve nearly all poses that have a solution. For the others the search begins
  // anew.
  constexpr int few_restarts = 64;
  const bool first = found.solutions->empty(), all = request.options.all;
  // If one solution is requested, the branch of the seed is tried first.
  if (!all && !request.quick) solve_from_seed(request, found);
  if (all || found.solutions->empty()) {
    const int restarts = request.quick ? few_restarts : request.options.max_restarts;
    search(state, request, search_within_bounds(state), restarts, all, found);
    if (found.solutions->empty() && !request.quick && any_finite(request.bounds) &&
        !found.unconstrained.complete && !request.budget.ended()) {
      search_without_limits(state, request, found);
    }
  }
  if (first && !found.solutions->empty()) found.result.method = "numerical";
}

}  // namespace beeline::internal
