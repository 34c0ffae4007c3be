#pragma once

#include <vector>

#include <beeline/control/internal/singular_rates.h>
#include <beeline/control/internal/velocity_bounds.h>
#include <beeline/control/internal/weighted_task.h>
#include <beeline/math/inverse_cholesky6.h>

namespace beeline::internal {

/// Resolved motion rates (Whitney 1969) in weighted least squares, without allocations:
///   minimise |x|^2  subject to  A x = c,    q̇ = W x    (weighted_task.h)
/// A coordinate whose bound for its position limit is exceeded is fixed at that bound, and the
/// others solve for the remainder, as long as there are more coordinates than rows (after Flacco,
/// De Luca & Khatib 2015). If A x = c has no solution, SingularRates computes the result.
class ResolvedRates {
 public:
  ResolvedRates(const Arm& arm, const Task& task);

  /// Sets q and the command; see WeightedTask::set().
  bool set(const ConfigurationRef& q, const Twist& command) { return task_.set(q, command); }

  /// Solves for rates. `last` is the joint velocity of the last step, which selects between equal
  /// solutions at a singularity.
  const Rates& solve(const ConfigurationRef& q, const std::vector<VelocityBounds>& bounds,
                     const Eigen::VectorXd& last, double time_step);

  /// Projects a joint velocity onto the null space of A, with the fixed coordinates at rest.
  void project_to_null_space(Eigen::VectorXd& velocity);

  const WeightedTask& task() const { return task_; }

 private:
  bool solve_least_squares();
  bool solve_within_bounds(const std::vector<VelocityBounds>& bounds);
  Eigen::Index farthest_outside(const std::vector<VelocityBounds>& bounds) const;
  void fill_acceleration(const ConfigurationRef& q);

  WeightedTask task_;
  std::vector<char> fixed_;   ///< coordinates at their bound for the position limit
  Eigen::VectorXd x_;         ///< weighted velocity
  Eigen::VectorXd previous_;  ///< x_ before the last coordinate was fixed
  InverseCholesky6 gram_;
  SingularRates singular_;
  Rates rates_;
};

}  // namespace beeline::internal
