#pragma once

#include <cstdint>
#include <vector>

#include <beeline/inverse/numerical.h>

namespace beeline {

struct SearchOptions {
  double tolerance = 1e-9;
  int iterations = 100;  ///< most steps in one try
  int restarts = 100;    ///< most tries after the first
  bool all = false;      ///< go on after the first solution, and collect those that differ
  std::uint64_t random_seed = 1;
};

struct Search {
  std::vector<Configuration> solutions;  ///< within the bounds, no two of them the same posture
  Descent nearest;                       ///< the try that came nearest, solution or not
  int iterations = 0;                    ///< over all tries
  int restarts = 0;                      ///< tries after the first
};

/// Descents from `start`, then from random configurations within the bounds (where there is none:
/// one turn for an angle, and lengths of the size of the arm), until one arrives. The same
/// random_seed gives the same search.
Search search(const Arm& arm, const Pose& world_T_tool, const Task& task, const Bounds& bounds,
              const Configuration& start, const SearchOptions& options);

}  // namespace beeline
