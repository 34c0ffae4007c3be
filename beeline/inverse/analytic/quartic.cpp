#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/analytic/quartic.h>

namespace beeline::internal {
namespace {

/// Returns the largest real root of x^3 + a x^2 + b x + c, by the formulas of Viete (three real
/// roots) or Cardano (one), then two Newton steps.
double largest_cubic_root(double a, double b, double c) {
  const double third = a / 3;
  const double p = b / 3 - third * third;
  const double q = third * third * third - third * b / 2 + c / 2;
  double x = 0;
  if (p < 0 && q * q < -p * p * p) {
    const double size = std::sqrt(-p);
    const double cosine = std::clamp(-q / (size * size * size), -1.0, 1.0);
    x = 2 * size * std::cos(std::acos(cosine) / 3);
  } else {
    const double root = std::sqrt(std::max(q * q + p * p * p, 0.0));
    const double u = -std::copysign(std::cbrt(std::abs(q) + root), q);
    x = u == 0 ? 0 : u - p / u;
  }
  x -= third;
  for (int i = 0; i < 2; ++i) {
    const double slope = (3 * x + 2 * a) * x + b;
    const double step = (((x + a) * x + b) * x + c) / slope;
    // A longer step does not help: the slope vanishes at a double root.
    if (std::isfinite(step) && std::abs(step) < 1e-3 * (1 + std::abs(x))) x -= step;
  }
  return x;
}

/// Writes the roots of x^2 + b x + c and returns their number. A discriminant down to -`slack`
/// counts as zero.
int quadratic_roots(double b, double c, double slack, double* roots) {
  const double discriminant = b * b / 4 - c;
  if (discriminant < -slack) return 0;
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double larger = -b / 2 - std::copysign(root, b);  // no cancellation
  roots[0] = larger;
  roots[1] = discriminant > 0 && larger != 0 ? c / larger : -b - larger;
  return 2;
}

/// Newton steps from x, as long as they reduce the value. At a double root they may not reduce it.
double refined_root(const std::array<double, 5>& c, double x) {
  const auto at = [&c](double t) { return (((c[4] * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0]; };
  double value = at(x);
  for (int step = 0; step < 4; ++step) {
    const double slope = ((4 * c[4] * x + 3 * c[3]) * x + 2 * c[2]) * x + c[1];
    const double next = x - value / slope, next_value = at(next);
    if (!(std::abs(next_value) < std::abs(value))) break;
    x = next;
    value = next_value;
  }
  return x;
}

}  // namespace

int quartic_roots(const std::array<double, 5>& c, std::array<double, 4>& roots) {
  const double a3 = c[3] / c[4], a2 = c[2] / c[4], a1 = c[1] / c[4], a0 = c[0] / c[4];
  // With x = y - a3/4: y^4 + p y^2 + q y + r = (y^2 + s y + g)(y^2 - s y + h), where s^2 is a root
  // of the resolvent cubic. The largest root is never negative.
  const double shift = a3 / 4, square = shift * shift;
  const double p = a2 - 6 * square;
  const double q = a1 - 2 * a2 * shift + 8 * square * shift;
  const double r = a0 - a1 * shift + a2 * square - 3 * square * square;
  const double ss = std::max(largest_cubic_root(2 * p, p * p - 4 * r, -q * q), 0.0);
  const double s = std::sqrt(ss);
  const double spread = s > 0 ? q / s : 2 * std::sqrt(std::max(p * p / 4 - r, 0.0));
  const double g = (p + ss - spread) / 2, h = (p + ss + spread) / 2;
  // A double root is known to half the digits, so the discriminant's rounding is about 1e-8 of its
  // terms.
  const double slack = 1e-7 * (std::abs(p) + ss + std::sqrt(std::abs(r)) + 1e-9 * square);
  int count = quadratic_roots(s, g, slack, roots.data());
  count += quadratic_roots(-s, h, slack, roots.data() + count);
  for (int i = 0; i < count; ++i) roots[i] = refined_root(c, roots[i] - shift);
  return count;
}

}  // namespace beeline::internal
