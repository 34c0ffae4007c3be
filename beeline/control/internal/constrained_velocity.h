#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <beeline/control/internal/bounded_list.h>

namespace beeline::internal {

/// The velocity nearest to another one that satisfies linear inequalities, without allocations:
///   minimise (x - x0)^T H (x - x0)  subject to  row_i . x >= least_i,  lower <= x <= upper
/// with H positive definite. Solves the dual problem, a least-squares problem with multipliers that
/// are not negative, by the active-set method of Lawson & Hanson (Solving Least Squares Problems,
/// 1974, chapter 23). If the inequalities contradict each other, the result violates some of them.
class ConstrainedVelocity {
 public:
  ConstrainedVelocity(int dof, int max_rows);

  void clear() { count_ = 0; }
  /// Adds an inequality; without effect if there are `max_rows` already. A row of zeros counts as
  /// satisfied.
  void add(const Eigen::VectorXd& row, double least);

  const Eigen::VectorXd& solve(const Eigen::MatrixXd& h, const Eigen::VectorXd& x0,
                               const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

  /// Returns the row with the largest multiplier of the last solve(), in the order of add(); -1 if
  /// none has one.
  int leading_row() const { return leading_; }

 private:
  int most_violated(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) const;
  double violation(int i, const Eigen::VectorXd& x, const Eigen::VectorXd& lower,
                   const Eigen::VectorXd& upper) const;
  double product(int i, const Eigen::Ref<const Eigen::VectorXd>& x) const;
  bool activate(int i);
  void deactivate(int place);
  bool solve_active(const Eigen::VectorXd& x0, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper);

  int dof_, max_rows_, count_ = 0, leading_ = -1;
  Eigen::MatrixXd rows_;   ///< unit vectors in columns
  Eigen::VectorXd least_;  ///< divided by the norm of the row
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd x_;
  BoundedList<int> active_;     ///< rows, then lower bounds, then upper bounds
  Eigen::MatrixXd directions_;  ///< H^-1 times the rows of the active inequalities
  Eigen::MatrixXd gram_;
  Eigen::VectorXd multipliers_, trial_;
};

}  // namespace beeline::internal
