#pragma once

#include <beeline/timing/internal/duration_problem.h>

namespace beeline::internal {

/// Newton's equations of the interior-point method of minimise_duration.h, reduced to the
/// coefficients: the slack of each limit times its multiplier shall equal `gap`. Arrays of
/// coefficients have `problem.coefficients()` numbers, arrays of multipliers
/// `problem.multipliers()`.
struct NewtonEquations {
  explicit NewtonEquations(const DurationProblem& problem);

  std::vector<double> gradient;
  std::vector<double> bands[3];  ///< of the Hessian: band d at k is its entry (k + d, k)
};

/// Computes the equations at the coefficients c; false where these violate a limit. The second
/// derivatives of the limits are omitted from the Hessian, so that it is positive definite.
bool set_up(NewtonEquations& equations, const DurationProblem& problem, const double* c,
            const double* multipliers, double gap);

/// The effect of a step on the multipliers.
struct MultiplierStep {
  double coefficients = 0, multipliers = 0;  ///< fractions of the step to the first bound
  /// The sum of slack times multiplier over all limits, and its derivatives with respect to the
  /// fraction of the step of the coefficients, of the multipliers, and of both; slacks to first
  /// order.
  double products = 0, by_coefficients = 0, by_multipliers = 0, by_both = 0;

  double products_after(double primal, double dual) const {
    return products + primal * by_coefficients + dual * (by_multipliers + primal * by_both);
  }
};

/// Computes the change of the multipliers that belongs to the change dc of the coefficients.
MultiplierStep multiplier_step(const DurationProblem& problem, const double* c, const double* dc,
                               const double* multipliers, double gap, double* change);

}  // namespace beeline::internal
