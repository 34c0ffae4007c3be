#include <algorithm>
#include <cmath>

#include <beeline/math/hermite.h>
#include <beeline/math/polynomial.h>

namespace beeline::internal {
namespace {

constexpr std::size_t degree = Polynomial::terms - 1;

/// The numbers from 0 to 1 between which a polynomial is monotonic, in order.
struct Breakpoints {
  std::array<double, Polynomial::terms + 1> u{};
  std::size_t count = 0;

  void add(double at) { u[count++] = at; }
};

/// The zero of a polynomial that is monotonic on [a, b], with values of opposite signs there:
/// bisection, as a Newton step may leave the interval where the slope vanishes.
double zero_between(const Polynomial& p, double a, double b) {
  const bool rising = p(a) < 0;
  for (;;) {
    const double middle = 0.5 * (a + b);
    if (!(middle > a && middle < b)) return middle;
    ((p(middle) < 0) == rising ? a : b) = middle;
  }
}

/// 0, the zeros of p between 0 and 1, and 1. p has terms up to u^`highest`.
Breakpoints zeros(const Polynomial& p, std::size_t highest) {
  Breakpoints found;
  found.add(0);
  if (highest > 0) {
    const Breakpoints monotonic = zeros(p.derivative(), highest - 1);
    for (std::size_t i = 1; i < monotonic.count; ++i) {
      const double a = monotonic.u[i - 1], b = monotonic.u[i];
      if ((p(a) < 0) != (p(b) < 0)) found.add(zero_between(p, a, b));
    }
  }
  found.add(1);
  return found;
}

}  // namespace

Polynomial Polynomial::part(double from, double to) const {
  Polynomial result;
  for (std::size_t k = terms; k-- > 0;) {  // Horner's scheme in the polynomial from + v (to - from)
    Polynomial next;
    for (std::size_t i = 0; i < terms; ++i) {
      next.c[i] = from * result.c[i] + (i > 0 ? (to - from) * result.c[i - 1] : 0);
    }
    next.c[0] += c[k];
    result = next;
  }
  return result;
}

Polynomial line_between(double p0, double p1) { return {{p0, p1 - p0}}; }

Polynomial cubic_between(double p0, double p1, double d0, double d1) {
  const double change = p1 - p0;
  return {{p0, d0, 3 * change - 2 * d0 - d1, d0 + d1 - 2 * change}};
}

Polynomial quintic_between(double p0, double p1, double d0, double d1, double dd0, double dd1) {
  const Quintic<double> q = quintic_between(p1 - p0, d0, dd0, d1, dd1);
  return {{p0, q.c[0], q.c[1], q.c[2], q.c[3], q.c[4]}};
}

Extremes enclosure(const Polynomial& p) {
  constexpr double binomial[] = {1, 5, 10, 10, 5, 1};  // of degree five
  // b_j = sum_k C(j, k) / C(5, k) c_k, by repeated sums of the scaled coefficients
  std::array<double, Polynomial::terms> b{};
  for (std::size_t k = 0; k <= degree; ++k) b[k] = p.c[k] / binomial[k];
  for (std::size_t level = 1; level <= degree; ++level) {
    for (std::size_t j = degree; j >= level; --j) b[j] += b[j - 1];
  }
  Extremes found{b[0], b[0]};
  for (const double value : b) {
    found = {std::min(found.smallest, value), std::max(found.largest, value)};
  }
  return found;
}

Extremes extremes(const Polynomial& p) {
  const double first = p(0), last = p(1);
  Extremes found{std::min(first, last), std::max(first, last)};
  const Polynomial slope = p.derivative();
  const Extremes slopes = enclosure(slope);
  if (slopes.smallest >= 0 || slopes.largest <= 0) return found;  // monotonic
  const Breakpoints candidates = zeros(slope, degree - 1);
  for (std::size_t i = 0; i < candidates.count; ++i) {
    const double value = p(candidates.u[i]);
    found = {std::min(found.smallest, value), std::max(found.largest, value)};
  }
  return found;
}

double largest_decrease(const Polynomial& p, double before) {
  const Polynomial slope = p.derivative();
  double largest = std::max(before, p(0)), decrease = largest - p(0);
  if (enclosure(slope).smallest >= 0) return decrease;
  const Breakpoints turns = zeros(slope, degree - 1);
  for (std::size_t i = 0; i < turns.count; ++i) {
    const double value = p(turns.u[i]);
    largest = std::max(largest, value);
    decrease = std::max(decrease, largest - value);
  }
  return decrease;
}

}  // namespace beeline::internal
