#include <algorithm>

#include <beeline/control/internal/bounded_least_squares.h>
#include <beeline/math/damped_least_squares.h>

namespace beeline::internal {

BoundedLeastSquares::BoundedLeastSquares(int dof)
    : fixed_(static_cast<std::size_t>(dof)), free_(6, dof), x_(dof) {}

void BoundedLeastSquares::solve_free(const Jacobian& a, const Rows& c, double damping,
                                     const Eigen::VectorXd& bias) {
  Rows remainder = c;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    remainder -= a.col(k) * (fixed_[k] ? x_[k] : bias[k]);
  }
  const Rows y = damped_multipliers(free_, remainder, damping);
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    if (!fixed_[k]) x_[k] = bias[k] + a.col(k).dot(y);
  }
}

const Eigen::VectorXd& BoundedLeastSquares::solve(const Jacobian& a, const Rows& c, double damping,
                                                  const Eigen::VectorXd& bias,
                                                  const Eigen::VectorXd& lower,
                                                  const Eigen::VectorXd& upper) {
  std::fill(fixed_.begin(), fixed_.end(), char{0});
  free_ = a;
  for (Eigen::Index pass = 0; pass <= x_.size(); ++pass) {
    solve_free(a, c, damping, bias);
    Eigen::Index worst = -1;
    double largest = 0;
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      const double excess = std::max(lower[k] - x_[k], x_[k] - upper[k]);
      if (fixed_[k] || !(excess > largest)) continue;
      largest = excess;
      worst = k;
    }
    if (worst < 0) break;
    fixed_[worst] = 1;
    free_.col(worst).setZero();
    x_[worst] = x_[worst] > upper[worst] ? upper[worst] : lower[worst];
  }
  return x_;
}

}  // namespace beeline::internal
