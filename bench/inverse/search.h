#pragma once

#include <vector>

#include "poses.h"

namespace beeline::bench {

struct SearchEffort {
  int starts = 4000;   ///< most random starts a pose
  int patience = 600;  ///< ends after so many starts in a row without a new solution
};

/// All solutions that Newton's method, damped (Levenberg-Marquardt), meets from random starts; no
/// two are the same to 1e-4 in every value, whole turns aside. Limits do not count. Shares nothing
/// with beeline/inverse. Throws Error unless six joints move.
std::vector<Configuration> searched_solutions(const Screws& screws, const Pose& goal,
                                              const SearchEffort& effort, Engine& engine);

}  // namespace beeline::bench
