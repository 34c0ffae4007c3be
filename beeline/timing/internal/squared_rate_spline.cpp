#include <beeline/timing/internal/squared_rate_spline.h>

namespace beeline::internal {

using Eigen::Matrix3d;

SquaredRateSpline::SquaredRateSpline(std::vector<double> knots)
    : coefficients(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(knots.size()) + 1)),
      knots_(std::move(knots)) {}

Matrix3d SquaredRateSpline::rows(std::size_t step, double u) const {
  const auto length = [this](std::size_t k) {  // of step k - 1; 0 outside
    return k == 0 || k == knots_.size() ? 0 : knots_[k] - knots_[k - 1];
  };
  const double before = length(step), here = length(step + 1), after = length(step + 2);
  // At the knots at both ends b is a weighted mean of two coefficients, and b' their difference
  // quotient.
  Matrix3d rows = Matrix3d::Zero();
  rows.row(0) << here / (before + here), before / (before + here), 0;
  rows.row(1) << -2 / (before + here), 2 / (before + here), 0;
  const Eigen::RowVector3d end_db(0, -2 / (here + after), 2 / (here + after));
  rows.row(2) = (end_db - rows.row(1)) / here;
  const double x = u * here;
  rows.row(0) += x * rows.row(1) + 0.5 * x * x * rows.row(2);
  rows.row(1) += x * rows.row(2);
  return rows;
}

SquaredRate SquaredRateSpline::begin_of(std::size_t step) const {
  const Eigen::Vector3d rate =
      rows(step, 0) * coefficients.segment<3>(static_cast<Eigen::Index>(step));
  return {rate[0], rate[1], rate[2]};
}

}  // namespace beeline::internal
