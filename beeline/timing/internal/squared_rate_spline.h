#pragma once

#include <Eigen/Core>
#include <vector>

namespace beeline::internal {

/// The squared rate b = (dtau/dt)^2 of a time scaling t(tau), and its derivatives with respect to
/// tau.
struct SquaredRate {
  double b = 1, db = 0, ddb = 0;

  /// The squared rate dtau later in the same step of the spline.
  SquaredRate after(double dtau) const {
    return {b + dtau * (db + 0.5 * dtau * ddb), db + dtau * ddb, ddb};
  }
};

/// b(tau) as a quadratic spline in B-spline form. It has one coefficient more than knots; knot k
/// lies between the maxima of the B-splines of coefficients k and k + 1.
class SquaredRateSpline {
 public:
  explicit SquaredRateSpline(std::vector<double> knots);

  std::size_t steps() const { return knots_.size() - 1; }
  const std::vector<double>& knots() const { return knots_; }

  /// The squared rate at the beginning of a step.
  SquaredRate begin_of(std::size_t step) const;

  /// The matrix that maps the coefficients step, step + 1, step + 2 to b, b' and b'' at the
  /// fraction u of the step.
  Eigen::Matrix3d rows(std::size_t step, double u) const;

  Eigen::VectorXd coefficients;

 private:
  std::vector<double> knots_;
};

}  // namespace beeline::internal
