#pragma once

#include <functional>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/gauss_newton.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/seed_table.h>

namespace beeline::internal {

/// Error, radians or units of length, below which runs that have stagnated may be next to a
/// solution: where two singularities meet. The nearest of all are continued last.
inline constexpr double near_a_solution = 1e-2;

struct MultiStartOptions {
  double tolerance = 1e-9;       ///< max position and orientation error, metres and radians
  int max_iterations = 100;      ///< max steps from one start
  int max_restarts = 1000;       ///< max starts after the first
  bool all = false;              ///< use all restarts, and collect the distinct solutions
  bool continue_nearest = true;  ///< without a solution, continue the runs of least error
  std::uint64_t random_seed = 1;
  /// Budget, which is checked every few steps; default: none. When it ends, the result holds the
  /// solutions found so far.
  BudgetMeter& budget = unlimited();
  /// Function that is called with each solution when it is found, with `all`; default: not called.
  std::function<void(const Configuration&)> found = {};
};

struct SearchResult {
  std::vector<Configuration> solutions;  ///< within the bounds, no two of them the same posture
  NumericalResult nearest;               ///< the run of least error, solution or not
  int iterations = 0;                    ///< number of iterations over all starts
  int restarts = 0;                      ///< number of starts after the first
};

/// Buffers that keep calls from allocating. Each thread needs its own.
struct MultiStartBuffers {
  GaussNewtonState near;
  LevenbergMarquardtLanes lanes;
  std::vector<double> q;
};

/// A problem of an arm and the seeds for it.
struct Search {
  const Arm& arm;
  const NumericalProblem& problem;
  const SeedTable& seeds;
};

/// Searches for a solution from several starts. First runs gauss_newton() from `start`, and
/// levenberg_marquardt() if the tool is near the pose there. Then runs run_lanes(): one lane from
/// `start`, seven from the seeds nearest to the pose; a lane that ends without converging starts
/// again from a random configuration. Ends when a lane converges. If several converge in the same
/// step, the solution is the one nearest to `start`. Lanes that have stagnated next to a solution
/// are continued by singular_solution(): some at once, and if no lane converges, the lanes of least
/// error. The solution is the representative nearest to
/// `result` is overwritten. Throws Error for a start or a pose that is not finite or does not fit,
/// and for an option out of range.
void multi_start(const Search& search, const Pose& world_T_tool, const ConfigurationRef& start,
                 const MultiStartOptions& options, MultiStartBuffers& buffers,
                 SearchResult& result);

/// Runs gauss_newton() from `start`, if the tool is near the pose there. Writes the run into
/// result.nearest and returns whether it converges. Allocates in the first call only.
bool search_from_start(const Search& search, const Pose& world_T_tool,
                       const ConfigurationRef& start, const MultiStartOptions& options,
                       MultiStartBuffers& buffers, SearchResult& result);

}  // namespace beeline::internal
