#include <algorithm>

#include <beeline/math/minimum_norm.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// Singular values above this one are not zero.
double rank_tolerance(const SixRowSvd& svd, std::optional<double> threshold) {
  const double largest = svd.singular_values[0];
  if (threshold) return *threshold * largest;
  return negligible_singular_value(largest, std::max<Eigen::Index>(6, svd.scaled_right.rows()));
}

}  // namespace

MinimumNormSolution minimum_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                          std::optional<double> threshold) {
  const SixRowSvd svd = six_row_svd(a);
  const double zero = rank_tolerance(svd, threshold);
  MinimumNormSolution solution{Eigen::VectorXd::Zero(a.cols())};
  for (int i = 0; i < 6; ++i) {
    const double sigma = svd.singular_values[i];
    if (!(sigma > zero)) continue;
    ++solution.rank;
    const double component = svd.left.col(i).head(b.size()).dot(b);
    // sigma^2 may overflow.
    solution.x += component / sigma * (svd.scaled_right.col(i) / sigma);
  }
  return solution;
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a) {
  const SixRowSvd svd = six_row_svd(a);
  const double zero = rank_tolerance(svd, std::nullopt);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(a.cols(), a.rows());
  for (int i = 0; i < 6; ++i) {
    const double sigma = svd.singular_values[i];
    if (!(sigma > zero)) continue;
    const Eigen::VectorXd left = svd.left.col(i).head(a.rows()) / sigma;
    inverse += svd.scaled_right.col(i) / sigma * left.transpose();
  }
  return inverse;
}

}  // namespace beeline::internal
