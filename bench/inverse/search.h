#pragma once

#include <vector>

#include "poses.h"

namespace beeline::bench {

struct SearchEffort {
  int starts = 4000;   ///< max random starts for each pose
  int patience = 600;  ///< ends after this many consecutive starts without a new solution
};

/// Returns all solutions that Levenberg-Marquardt finds from random starts, distinct by 1e-4 in
/// some value modulo full revolutions. Ignores limits. Shares no code with beeline/inverse. Throws
/// Error unless six joints are not locked.
std::vector<Configuration> searched_solutions(const Screws& screws, const Pose& goal,
                                              const SearchEffort& effort, Engine& engine);

}  // namespace beeline::bench
