#pragma once

#include <Eigen/Core>
#include <vector>

namespace beeline {

/// A motion that is to keep its limits, at one side of one of its moments. With b the square of the
/// rate at which its clock runs, b' and b'' by the motion's own time, it then moves with
///     velocity      v sqrt(b)
///     acceleration  a b + v b' / 2
///     jerk          sqrt(b) (j b + 3/2 a b' + v b'' / 2)
/// all divided by the limits.
struct ClockMoment {
  std::size_t step = 0;            ///< of the clock's spline
  double share = 0;                ///< of this step, from 0 to 1
  Eigen::VectorXd velocity_v;      ///< v by the limit of velocity
  Eigen::VectorXd acceleration_v;  ///< v by the limit of acceleration
  Eigen::VectorXd acceleration_a;
  Eigen::VectorXd jerk_v, jerk_a, jerk_j;
  double most = 0;  ///< b's largest value for the limits of velocity
};

/// b and its derivatives at one side of a moment.
struct ClockRate {
  double b = 1, slope = 0, bend = 0;
};

/// The largest share of a limit: of velocity as its square, of acceleration and jerk.
struct ClockShares {
  double velocity_squared = 0, acceleration = 0, jerk = 0;
};
ClockShares shares(const ClockMoment& moment, const ClockRate& rate);

/// The rate of the clock between moments: b is a quadratic spline with `knots` in the motion's own
/// time, one coefficient more than knots; knot k is between coefficients k and k + 1.
class ClockSpline {
 public:
  explicit ClockSpline(std::vector<double> knots);

  std::size_t steps() const { return knots_.size() - 1; }
  const std::vector<double>& knots() const { return knots_; }

  /// At the time t of step k.
  ClockRate at(std::size_t step, double t) const;

  /// What the coefficients k, k + 1, k + 2 do to b, b' and b'' at the share of step k: a column for
  /// each coefficient.
  Eigen::Matrix3d rows(std::size_t step, double share) const;

  Eigen::VectorXd coefficients;

 private:
  std::vector<double> knots_;
};

/// Makes the clock as fast as the moments allow, from coefficients that keep all limits with room
/// to spare. The moments are in order; at least the begin and the end of each step are among them.
void hasten(ClockSpline& clock, const std::vector<ClockMoment>& moments);

}  // namespace beeline
