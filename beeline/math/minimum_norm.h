#pragma once

#include <Eigen/Core>

namespace beeline::internal {

/// The least-squares solution of A x = b with the least norm.
struct MinimumNormSolution {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;  ///< of A
};

/// Minimises |A x - b|, and |x| among the minimisers, by a complete orthogonal decomposition.
/// `threshold`: pivots below this fraction of the largest count as zero.
MinimumNormSolution minimum_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          double threshold);

}  // namespace beeline::internal
