#pragma once

#include <beeline/timing/internal/duration_problem.h>

namespace beeline {

/// Newton's equations of the interior-point method of clock_barrier.h: what is left of each limit,
/// times its multiplier, is to become `gap`. Arrays by coefficients are as long as
/// `problem.coefficients()`, those by multipliers as `problem.multipliers()`.
struct NewtonEquations {
  explicit NewtonEquations(const DurationProblem& problem);

  std::vector<double> gradient;
  std::vector<double> bands[3];  ///< of the Hessian: band d at k is its entry (k + d, k)
};

/// At the coefficients c; false where these do not keep a limit. Of the Hessian the bends of the
/// limits are left out, so that it is positive.
bool set_up(NewtonEquations& equations, const DurationProblem& problem, const double* c,
            const double* multipliers, double gap);

/// What a step does to the multipliers.
struct MultiplierStep {
  double coefficients = 0, multipliers = 0;  ///< parts of the step that lead to the first bound
  /// The sum of what is left of each limit times its multiplier, and how it changes with a part of
  /// the coefficients' step, one of the multipliers' and both; all to first order.
  double products = 0, by_coefficients = 0, by_multipliers = 0, by_both = 0;

  double products_after(double part, double part_of_multipliers) const {
    return products + part * by_coefficients +
           part_of_multipliers * (by_multipliers + part * by_both);
  }
};

/// The change of the multipliers that belongs to the change dc of the coefficients.
MultiplierStep multiplier_step(const DurationProblem& problem, const double* c, const double* dc,
                               const double* multipliers, double gap, double* change);

}  // namespace beeline
