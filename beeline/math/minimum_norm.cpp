#include <Eigen/QR>

#include <beeline/math/minimum_norm.h>

namespace beeline::internal {

MinimumNormSolution minimum_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          std::optional<double> threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  if (threshold) decomposition.setThreshold(*threshold);
  decomposition.compute(a);
  return {decomposition.solve(b), decomposition.rank()};
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace beeline::internal
