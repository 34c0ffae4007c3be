#pragma once

#include <Eigen/Core>
#include <vector>

namespace beeline {

/// The square b of the rate at which a clock runs, and its derivatives by a motion's own time.
struct SquaredRate {
  double b = 1, slope = 0, bend = 0;

  /// That much later in the same step.
  SquaredRate after(double t) const {
    return {b + t * (slope + 0.5 * t * bend), slope + t * bend, bend};
  }
};

/// b as a quadratic spline with `knots` in the motion's own time, one coefficient more than knots;
/// knot k is between coefficients k and k + 1.
class SquaredRateSpline {
 public:
  explicit SquaredRateSpline(std::vector<double> knots);

  std::size_t steps() const { return knots_.size() - 1; }
  const std::vector<double>& knots() const { return knots_; }

  SquaredRate begin_of(std::size_t step) const;

  /// What the coefficients k, k + 1, k + 2 do to b, b' and b'' at the share of step k: a column for
  /// each coefficient.
  Eigen::Matrix3d rows(std::size_t step, double share) const;

  Eigen::VectorXd coefficients;

 private:
  std::vector<double> knots_;
};

}  // namespace beeline
