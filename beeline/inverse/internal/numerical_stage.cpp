#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/nearest_search.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/stages.h>
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

/// Runs Levenberg-Marquardt within limits from up to eight starts, and writes the first solution to
/// which one converges into q. Returns whether there is one.
bool solve_from(SolverState& state, const Request& request, std::span<const double* const> starts,
                Configuration& q) {
  const NumericalProblem& problem = problem_within_bounds(state);
  LevenbergMarquardtLanes& lanes = state.buffers().lanes;
  lanes.active = lanes.converged = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    start_lane(problem, starts[i], static_cast<int>(i), lanes);
  }
  const int max_iterations = request.options.max_iterations;
  while (lanes.active != 0 && lanes.converged == 0) {
    run_lanes(
        problem, request.goal,
        {.tolerance = request.tolerance, .max_iterations = max_iterations, .first_is_enough = true},
        max_iterations, lanes);
  }
  if (lanes.converged == 0) return false;
  lane_configuration(problem, lanes, std::countr_zero(lanes.converged), q.data());
  return true;
}

// Restarts without limits that show that a pose has no solution.
constexpr int open_restarts = 32;

/// Whether the last search, limits ignored, was long enough and ended far from the pose, or at a
/// minimum of the error.
bool ended_far(SolverState& state, const Request& request) {
  // Units of length and radians: twice the error from which multi_start() continues a run. A
  // configuration at the position and within `clear` of the orientation would be nearer.
  constexpr double far = 2 * near_a_solution, clear = 1e-3;
  const SearchResult& last = state.search();
  const int enough = request.quick ? open_restarts : max_starts;
  if (last.nearest.converged || last.restarts < enough || !request.budget.complete() ||
      request.options.max_iterations < MultiStartOptions{}.max_iterations) {
    return false;
  }
  const Deviation& error = last.nearest.error;
  return std::max(error.position / unit_of_length(request.arm), error.orientation) > far ||
         (request.quick && is_minimum_above(request, last.nearest.q, clear));
}

/// Searches without limits for a posture that has another representative within them, or that is a
/// start from which Levenberg-Marquardt converges to a solution within them. The postures least
/// outside the limits are tried first.
void search_without_limits(SolverState& state, const Request& request, int restarts, bool all,
                           StageResult& found) {
  const Kept<NumericalProblem> open(request.arm, NumericalProblem::Key{request.task, true});
  search(state, request, {request.arm, *open, seeds_for(state, true, *open)}, restarts, all, found);
  std::vector<std::pair<double, Configuration>> starts;
  for (const Configuration& q : state.search().solutions) {
    found.unconstrained.consider(request, q);
    Configuration nearest = nearest_representative(request.arm, q, request.seed, request.bounds);
    starts.emplace_back(excess(request.bounds, nearest), std::move(nearest));
  }
  std::sort(starts.begin(), starts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Configuration q(request.arm.dof());
  for (std::size_t first = 0; first < starts.size(); first += solver_lane_count) {
    if (!found.solutions->empty() || request.budget.ended()) break;
    const double* eight[solver_lane_count];
    const std::size_t count = std::min<std::size_t>(solver_lane_count, starts.size() - first);
    for (std::size_t i = 0; i < count; ++i) eight[i] = starts[first + i].second.data();
    if (solve_from(state, request, {eight, count}, q)) add_solution(request, q, found);
  }
}

/// Few restarts solve nearly all poses that have a solution. Most of the others have none without
/// limits either. For seven revolute joints it takes few restarts to see that, as most runs without
/// limits converge.
void search_quickly(SolverState& state, const Request& request, StageResult& found) {
  constexpr int first_restarts = 16, few_restarts = 64;
  const Search within = search_within_bounds(state);
  const bool seven = !state.family && has_revolute_joints(state, 7);
  const bool six = !state.family && state.fallback && has_revolute_joints(state, 6);
  const bool limited = any_finite(request.bounds);
  const int restarts = six || (seven && limited) ? first_restarts
                       : seven                   ? open_restarts
                                                 : few_restarts;
  search(state, request, within, restarts, false, found);
  const auto none = [&] { return found.solutions->empty() && request.budget.complete(); };
  // Whether the closed form applies takes milliseconds to find out for a new arm.
  if (six && none() && !state.fallback->applies(state)) {
    search(state, request, within, few_restarts, false, found);
  }
  if (!seven || !none()) return;
  if (limited) search_without_limits(state, request, open_restarts, false, found);
  found.unconstrained.far = none() && ended_far(state, request);
  if (none() && !found.unconstrained.far) {
    search(state, request, within, few_restarts, false, found);
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
    if (!solve_from(state, request, {&start, 1}, q)) return false;
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
    const double distance = distance_from_seed(request, q);
    const bool nearer = distance < distance_from_seed(request, each.q);
    if (!nearer || error > request.tolerance) continue;
    each.q = q;  // in its memory
    each.error = error;
    each.distance = distance;
    each.regular = false;
  }
}

bool solve_from_outside(SolverState& state, const Request& request, const LeastOutside& outside,
                        Configuration& q) {
  const double* starts[LeastOutside::capacity];
  for (int i = 0; i < outside.count; ++i) starts[i] = outside.q[i];
  return solve_from(state, request, {starts, static_cast<std::size_t>(outside.count)}, q);
}

void solve_numerical(SolverState& state, const Request& request, StageResult& found) {
  const bool first = found.solutions->empty(), all = request.options.all;
  const bool may_be_within = !is_out_of_reach_within_bounds(state, request);
  // If one solution is requested, the branch of the seed is tried first.
  if (!all && !request.quick && may_be_within) solve_from_seed(request, found);
  if (request.quick && !all) {
    if (may_be_within) search_quickly(state, request, found);
  } else if (all || found.solutions->empty()) {
    if (may_be_within) {
      search(state, request, search_within_bounds(state), request.options.max_restarts, all, found);
    }
    if (found.solutions->empty() && any_finite(request.bounds) && !found.unconstrained.complete &&
        !request.budget.ended()) {
      // More restarts find more postures, but most requests in this stage have no solution.
      constexpr int max_restarts_without_limits = 100;
      search_without_limits(state, request, max_restarts_without_limits, true, found);
    }
    found.unconstrained.far = found.solutions->empty() && ended_far(state, request);
  }
  if (first && !found.solutions->empty()) found.result.method = "numerical";
}

}  // namespace beeline::internal
