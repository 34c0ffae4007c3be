#pragma once

#include <chrono>

#include <beeline/inverse/numerical/gauss_newton.h>
#include <beeline/inverse/numerical/seed_table.h>

namespace beeline::internal {

struct MultiStartOptions {
  double tolerance = 1e-9;  ///< metres and radians
  int iterations = 100;     ///< most steps of one descent
  int restarts = 1000;      ///< most descents after the first
  bool all = false;         ///< run all descents, and collect the solutions that differ
  std::uint64_t random_seed = 1;
  /// Looked at every few steps; what has been found by then is the answer.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
};

struct SearchResult {
  std::vector<Configuration> solutions;  ///< within the bounds, no two of them the same posture
  NumericalResult nearest;               ///< the descent that came nearest, solution or not
  int iterations = 0;                    ///< over all descents
  int restarts = 0;                      ///< descents after the first
};

/// One thread's buffers, so that calls do not allocate.
struct MultiStartBuffers {
  GaussNewtonState near;
  LevenbergMarquardtLanes lanes;
  std::vector<double> q;
};

/// PreparedSearch until one arrives, eight at a time: one from `start`, seven from the seeds's
/// configurations that come nearest to the pose, then from random ones: a descent that ends
/// without arriving makes room for the next. Before them gauss_newton() tries to arrive
/// from `start`, which may be near the pose. Of several that arrive in the same step the one
/// nearest to `start` is the solution, at the turn nearest to it. `iterations` counts the steps of
/// all descents. The same seeds and random_seed give the same answer, where there is no deadline;
/// whatever `result` was before. Throws Error for a start or a pose that is not finite or does not
/// fit, and for an option out of range.
void multi_start(const NumericalProblem& problem, const SeedTable& seeds, const Pose& world_T_tool,
                 const ConfigurationRef& start, const MultiStartOptions& options,
                 MultiStartBuffers& buffers, SearchResult& result);

}  // namespace beeline::internal
