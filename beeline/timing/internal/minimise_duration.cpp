#include <algorithm>

#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/newton_equations.h>

namespace beeline::internal {
namespace {

// The gap of a limit is its slack times its multiplier, in units of the duration of one step of the
// spline.
constexpr double first_gap = 1;
constexpr double last_gap = 1e-4;       // a smaller gap changes less than the knots' error
constexpr double step_fraction = 0.95;  // of the step to the first bound (fraction to the boundary)
constexpr int max_steps = 50;           // a bound; the gap usually ends the iteration
constexpr int max_backtracks = 20;      // of factor 0.7: to 1e-3 of the step

/// Returns the factor for the next gap after a step of this fraction of a Newton step. The gap is
/// reduced less after a short step, so that the coefficients can follow the multipliers.
double gap_reduction(double fraction) { return fraction > 0.9 ? 0.2 : fraction > 0.5 ? 0.6 : 1; }

/// Solves the equations for the first `size` coefficients by the LDL^T factorisation of the banded
/// Hessian, which overwrites it.
void solve(NewtonEquations& equations, std::size_t size, std::vector<double>& x) {
  auto& [gradient, bands] = equations;
  auto& [middle, first, second] = bands;
  for (std::size_t k = 0; k < size; ++k) x[k] = -gradient[k];
  for (std::size_t k = 0; k < size; ++k) {
    const double inverse = 1 / middle[k], one = first[k] * inverse, two = second[k] * inverse;
    if (k + 1 < size) {
      middle[k + 1] -= one * first[k];
      first[k + 1] -= one * second[k];
      x[k + 1] -= one * x[k];
    }
    if (k + 2 < size) {
      middle[k + 2] -= two * second[k];
      x[k + 2] -= two * x[k];
    }
    first[k] = one;
    second[k] = two;
    x[k] *= inverse;
  }
  for (std::size_t k = size - 1; k-- > 0;) {
    x[k] -= first[k] * x[k + 1];
    if (k + 2 < size) x[k] -= second[k] * x[k + 2];
  }
}

void add(std::vector<double>& to, double fraction, const std::vector<double>& step) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += fraction * step[k];
}

}  // namespace

void minimise_duration(SquaredRateSpline& spline, const DurationProblem& problem,
                       BudgetMeter& budget) {
  const auto size = static_cast<std::size_t>(spline.coefficients.size());
  std::vector<double> c(problem.coefficients(), 1), next(c), dc(c.size(), 0);
  std::copy(spline.coefficients.begin(), spline.coefficients.end(), c.begin());
  std::vector<double> multipliers(problem.multipliers(), 1), change(multipliers.size());
  const double unit = 1 / double(spline.steps()), count = double(multipliers.size());
  double gap = first_gap * unit;
  // Multipliers with exactly this gap.
  multiplier_step(problem, c.data(), dc.data(), multipliers.data(), gap, change.data());
  add(multipliers, 1, change);
  NewtonEquations equations(problem);
  bool inside = set_up(equations, problem, c.data(), multipliers.data(), gap);
  constexpr std::size_t steps_of_work = 16;  // of the spline, in an iteration that counts once
  const auto work = static_cast<std::int64_t>(1 + spline.steps() / steps_of_work);
  for (int i = 0; i < max_steps && inside && !budget.ended(work); ++i) {
    solve(equations, size, dc);
    if (budget.ended(0)) break;
    const MultiplierStep step =
        multiplier_step(problem, c.data(), dc.data(), multipliers.data(), gap, change.data());
    double primal = std::min(1.0, step_fraction * step.coefficients);
    const double dual = std::min(1.0, step_fraction * step.multipliers);
    add(multipliers, dual, change);
    const double reached = step.products_after(primal, dual) / count;
    gap = reached * gap_reduction(std::min(primal, dual));
    // The limits are not linear, so coefficients that satisfy them to first order may violate them.
    for (int tries = 0; tries < max_backtracks; ++tries, primal *= 0.7) {
      inside = !budget.ended(0);
      if (!inside) break;
      next = c;
      add(next, primal, dc);
      inside = set_up(equations, problem, next.data(), multipliers.data(), gap);
      if (inside) break;
    }
    if (inside) std::swap(c, next);
    if (reached < last_gap * unit && primal > 0.5) break;
  }
  std::copy_n(c.begin(), size, spline.coefficients.begin());
}

}  // namespace beeline::internal
