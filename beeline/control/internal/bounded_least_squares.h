#pragma once

#include <vector>

#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// Damped least squares within bounds, without allocations:
///   minimise |A x - c|^2 + damping |x - bias|^2  subject to  lower <= x <= upper
/// by an active set: the coordinate that exceeds its bound most is fixed there and the others are
/// solved again, as in ResolvedRates. A fixed coordinate is not released, so the result is within
/// the bounds, but the minimum only where the set is the optimal one.
class BoundedLeastSquares {
 public:
  using Rows = Eigen::Matrix<double, 6, 1>;

  explicit BoundedLeastSquares(int dof);

  const Eigen::VectorXd& solve(const Jacobian& a, const Rows& c, double damping,
                               const Eigen::VectorXd& bias, const Eigen::VectorXd& lower,
                               const Eigen::VectorXd& upper);

 private:
  void solve_free(const Jacobian& a, const Rows& c, double damping, const Eigen::VectorXd& bias);

  std::vector<char> fixed_;
  Jacobian free_;  ///< A with the columns of fixed coordinates set to zero
  Eigen::VectorXd x_;
};

}  // namespace beeline::internal
