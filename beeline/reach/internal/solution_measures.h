#pragma once

#include <cmath>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The least margin to the limits (limit_margin()), at most 1, of the coordinates from `begin` to
/// `end` - 1; of solutions that rounding moved outside, 0.
double least_margin(const Arm& arm, const ConfigurationRef& q, int begin, int end);

/// Raises the largest value so far, NaN before the first. Ignores a value that is NaN.
inline void keep_max(float& largest, float value) {
  if (value > largest || std::isnan(largest)) largest = value;
}

/// One value for each configuration.
struct SolutionMeasures {
  std::vector<float> manipulability, margin;
};

/// Computes the manipulability, and the least margin of the coordinates from `begin` to `end` - 1,
/// of configurations, one in each column of q.
SolutionMeasures solution_measures(const Arm& arm, const Eigen::Ref<const Eigen::MatrixXd>& q,
                                   int begin, int end);

}  // namespace beeline::internal
