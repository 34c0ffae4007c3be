#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>

#include <tests/random.h>

namespace beeline::testing {

using namespace internal;

inline Configuration found(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                           int lane) {
  Configuration q(problem.coordinates.size());
  lane_configuration(problem, lanes, lane, q.data());
  return q;
}

/// Eight starts within `size` of q.
inline Eigen::MatrixXd starts_near(const Configuration& q, double size, Random& random) {
  Eigen::MatrixXd starts(q.size(), solver_lane_count);
  for (double& start : starts.reshaped()) start = random.uniform(-size, size);
  return starts.colwise() + q;
}

}  // namespace beeline::testing
