#include <algorithm>
#include <cmath>

#include <beeline/control/internal/bounded_least_squares.h>
#include <beeline/math/damped_least_squares.h>

namespace beeline::internal {

BoundedLeastSquares::BoundedLeastSquares(int dof)
    : side_(static_cast<std::size_t>(dof)), free_(6, dof), x_(dof), unbounded_(dof) {}

/// Sets unbounded_. Fixed coordinates keep their values.
void BoundedLeastSquares::solve_free(const Jacobian& a, const Rows& c, double damping,
                                     const Eigen::VectorXd& bias) {
  Rows remainder = c;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    unbounded_[k] = side_[k] ? x_[k] : bias[k];
    remainder -= a.col(k) * unbounded_[k];
  }
  const Rows y = damped_multipliers(free_, remainder, damping);
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    if (!side_[k]) unbounded_[k] += a.col(k).dot(y);
  }
}

/// Moves x_ towards unbounded_ as far as the bounds allow. Fixes the coordinate that reaches its
/// bound, and returns whether there is one.
bool BoundedLeastSquares::move_to_first_bound(const Eigen::VectorXd& lower,
                                              const Eigen::VectorXd& upper) {
  double fraction = 1;
  Eigen::Index first = -1;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    const double step = unbounded_[k] - x_[k];
    const double room = (step > 0 ? upper[k] : lower[k]) - x_[k];
    if (side_[k] || !(std::abs(step) * fraction > std::abs(room))) continue;
    fraction = room / step;
    first = k;
  }
  x_ += fraction * (unbounded_ - x_);
  if (first < 0) return false;
  const bool up = unbounded_[first] > x_[first];
  side_[first] = up ? 1 : -1;
  x_[first] = up ? upper[first] : lower[first];
  free_.col(first).setZero();
  return true;
}

/// Releases the fixed coordinate along which f decreases most. Returns whether there is one.
bool BoundedLeastSquares::release(const Jacobian& a, const Rows& c, double damping,
                                  const Eigen::VectorXd& bias) {
  constexpr double rounding = 1e-12;
  const Rows remainder = c - a * x_;
  double largest = rounding * a.norm() * c.norm();
  Eigen::Index worst = -1;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    const double inward =
        -side_[k] * (a.col(k).dot(remainder) - damping * (x_[k] - bias[k]));  // this is -f' / 2
    if (!(inward > largest)) continue;
    largest = inward;
    worst = k;
  }
  if (worst < 0) return false;
  side_[worst] = 0;
  free_.col(worst) = a.col(worst);
  return true;
}

const Eigen::VectorXd& BoundedLeastSquares::solve(const Jacobian& a, const Rows& c, double damping,
                                                  const Eigen::VectorXd& bias,
                                                  const Eigen::VectorXd& lower,
                                                  const Eigen::VectorXd& upper) {
  std::fill(side_.begin(), side_.end(), static_cast<signed char>(0));
  free_ = a;
  x_.setZero();
  bool any_fixed = false;
  const Eigen::Index max_passes = 3 * x_.size() + 3;
  for (Eigen::Index pass = 0; pass < max_passes; ++pass) {
    solve_free(a, c, damping, bias);
    if (move_to_first_bound(lower, upper)) {
      any_fixed = true;
    } else if (!any_fixed || !release(a, c, damping, bias)) {
      break;
    }
  }
  return x_;
}

}  // namespace beeline::internal
