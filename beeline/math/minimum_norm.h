#pragma once

#include <Eigen/Core>
#include <optional>

namespace beeline::internal {

/// The least-squares solution of A x = b with the least norm.
struct MinimumNormSolution {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;  ///< of A
};

/// Minimises |A x - b|, and |x| among the minimisers, by the singular value decomposition of A,
/// which has at most six rows. `threshold`: singular values up to this fraction of the largest
/// count as zero; the default is rounding.
MinimumNormSolution minimum_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          std::optional<double> threshold = std::nullopt);

/// Returns the Moore-Penrose inverse of A, by the same decomposition.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

}  // namespace beeline::internal
