#include <Eigen/QR>

#include <beeline/math/minimum_norm.h>

namespace beeline::internal {

MinimumNormSolution minimum_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  decomposition.compute(a);
  return {decomposition.solve(b), decomposition.rank()};
}

}  // namespace beeline::internal
