#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include <beeline/pose/se3.h>

namespace beeline::testing {

/// The weights with sum 1 of the point of least norm in the affine hull of the columns.
inline Eigen::VectorXd affine_minimum(const Eigen::MatrixXd& points) {
  const Eigen::Index count = points.cols();
  Eigen::VectorXd weights = Eigen::VectorXd::Unit(count, 0);
  if (count == 1) return weights;
  const Eigen::MatrixXd edges = points.rightCols(count - 1).colwise() - points.col(0).eval();
  const Eigen::VectorXd along = edges.completeOrthogonalDecomposition().solve(-points.col(0));
  weights << 1 - along.sum(), along;
  return weights;
}

/// The distance of a point from the convex hull of points, or a little more: the norm of a weighted
/// mean (Wolfe, "Finding the nearest point in a polytope", 1976).
inline double distance_from_hull(const std::vector<Vector3>& vertices, const Vector3& point) {
  double size = 0;
  for (const Vector3& vertex : vertices) size = std::max(size, (vertex - point).norm());
  if (size == 0) return 0;
  const auto count = static_cast<Eigen::Index>(vertices.size());
  Eigen::MatrixXd p(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    p.col(i) = (vertices[static_cast<std::size_t>(i)] - point) / size;
  }
  std::vector<Eigen::Index> corral{0};
  std::vector<double> weights{1};
  Vector3 nearest = p.col(0);
  for (int step = 0; step < 300; ++step) {
    Eigen::Index next = 0;
    const double along = (p.transpose() * nearest).minCoeff(&next);
    // The error is at most the square root of this, times the size.
    if (nearest.squaredNorm() - along <= 1e-22) break;
    if (std::find(corral.begin(), corral.end(), next) != corral.end()) break;
    corral.push_back(next);
    weights.push_back(0);
    while (true) {
      Eigen::MatrixXd part(3, static_cast<Eigen::Index>(corral.size()));
      for (std::size_t i = 0; i < corral.size(); ++i) {
        part.col(static_cast<Eigen::Index>(i)) = p.col(corral[i]);
      }
      const Eigen::VectorXd best = affine_minimum(part);
      double share = 1;
      std::size_t leaves = corral.size();
      for (std::size_t i = 0; i < corral.size(); ++i) {
        const double to = best[static_cast<Eigen::Index>(i)];
        if (to >= 0 || weights[i] - to <= 0 || weights[i] / (weights[i] - to) >= share) continue;
        share = weights[i] / (weights[i] - to);
        leaves = i;
      }
      nearest.setZero();
      for (std::size_t i = 0; i < corral.size(); ++i) {
        weights[i] += share * (best[static_cast<Eigen::Index>(i)] - weights[i]);
        nearest += weights[i] * p.col(corral[i]);
      }
      if (leaves == corral.size()) break;
      corral.erase(corral.begin() + static_cast<std::ptrdiff_t>(leaves));
      weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(leaves));
    }
  }
  return size * nearest.norm();
}

}  // namespace beeline::testing
