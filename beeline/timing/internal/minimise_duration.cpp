#include <algorithm>

#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/newton_equations.h>

namespace beeline {
namespace {

// Gaps, what is left of a limit times its multiplier, are told as parts of the duration that one
// step of the clock takes.
constexpr double first_gap = 1;
constexpr double last_gap = 1e-4;
constexpr double longest = 0.95;  // of the way to the first bound, that one goes
constexpr int max_steps = 50;

/// By what factor the gap is to shrink next, after a part of a step: after a short one the
/// coefficients have to come up with the multipliers first.
double shrinking(double part) { return part > 0.9 ? 0.2 : part > 0.5 ? 0.6 : 1; }

/// Solves the equations for the first `size` coefficients, by the factors L D L^T of the Hessian,
/// which they take the place of.
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

void add(std::vector<double>& to, double part, const std::vector<double>& step) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += part * step[k];
}

}  // namespace

void minimise_duration(SquaredRateSpline& clock, const DurationProblem& problem) {
  const auto size = static_cast<std::size_t>(clock.coefficients.size());
  std::vector<double> c(problem.coefficients(), 1), next(c), dc(c.size(), 0);
  std::copy(clock.coefficients.begin(), clock.coefficients.end(), c.begin());
  std::vector<double> multipliers(problem.multipliers(), 1), change(multipliers.size());
  const double unit = 1 / double(clock.steps()), count = double(multipliers.size());
  double gap = first_gap * unit;
  // Multipliers that fit the gap.
  multiplier_step(problem, c.data(), dc.data(), multipliers.data(), gap, change.data());
  add(multipliers, 1, change);
  NewtonEquations equations(problem);
  bool inside = set_up(equations, problem, c.data(), multipliers.data(), gap);
  for (int i = 0; i < max_steps && inside; ++i) {
    solve(equations, size, dc);
    const MultiplierStep step =
        multiplier_step(problem, c.data(), dc.data(), multipliers.data(), gap, change.data());
    double part = std::min(1.0, longest * step.coefficients);
    const double part_of_multipliers = std::min(1.0, longest * step.multipliers);
    add(multipliers, part_of_multipliers, change);
    const double reached = step.products_after(part, part_of_multipliers) / count;
    gap = reached * shrinking(std::min(part, part_of_multipliers));
    // The limits bend: what is inside to first order may be outside.
    for (int tries = 0; tries < 20; ++tries, part *= 0.7) {
      next = c;
      add(next, part, dc);
      inside = set_up(equations, problem, next.data(), multipliers.data(), gap);
      if (inside) break;
    }
    if (inside) std::swap(c, next);
    if (reached < last_gap * unit && part > 0.5) break;
  }
  std::copy_n(c.begin(), size, clock.coefficients.begin());
}

}  // namespace beeline
