#pragma once

#include <vector>

#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// Damped least squares within bounds, without allocations:
///   minimise f(x) = |A x - c|^2 + damping |x - bias|^2  subject to  lower <= x <= upper
/// by the active-set method of Stark & Parker (Computational Statistics 10, 1995) from x = 0, which
/// is within the bounds: f decreases with each pass. Passes are limited; one suffices if no bound
/// is reached.
class BoundedLeastSquares {
 public:
  using Rows = Eigen::Matrix<double, 6, 1>;

  explicit BoundedLeastSquares(int dof);

  const Eigen::VectorXd& solve(const Jacobian& a, const Rows& c, double damping,
                               const Eigen::VectorXd& bias, const Eigen::VectorXd& lower,
                               const Eigen::VectorXd& upper);

 private:
  void solve_free(const Jacobian& a, const Rows& c, double damping, const Eigen::VectorXd& bias);
  bool move_to_first_bound(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  bool release(const Jacobian& a, const Rows& c, double damping, const Eigen::VectorXd& bias);

  /// 1 or -1 for a coordinate fixed at its upper or lower bound, 0 for a free one.
  std::vector<signed char> side_;
  Jacobian free_;  ///< A with the columns of fixed coordinates set to zero
  Eigen::VectorXd x_;
  Eigen::VectorXd unbounded_;  ///< the minimum over the coordinates that are not fixed
};

}  // namespace beeline::internal
