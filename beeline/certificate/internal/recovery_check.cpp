#include <algorithm>

#include <beeline/certificate/internal/recovery_check.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {
namespace {

/// Returns the largest e(b) - max(e(a), 0) for a <= b, for a polynomial e that begins at `before`
/// or lower.
double largest_rise(const Polynomial& e, double before) {
  Polynomial negative = e;
  for (double& c : negative.c) c = -c;
  const double whole = largest_decrease(negative, -before);
  if (whole <= position_slack) return std::max(0.0, whole);
  // The polynomial may fall below zero and rise again there. It is divided at a zero or below it.
  constexpr int parts = 64;
  int inside = 0;
  while (inside <= parts && e(static_cast<double>(inside) / parts) > 0) ++inside;
  if (inside > parts) return whole;
  const double u = static_cast<double>(inside) / parts;
  const double until = inside == 0 ? 0 : largest_decrease(negative.part(0, u), -before);
  const double after = inside == parts ? 0 : extremes(e.part(u, 1)).largest;
  return std::max({0.0, until, after});
}

}  // namespace

RecoveryCheck::RecoveryCheck(const Arm& arm, const Trajectory& trajectory, double recover)
    : arm_(arm), trajectory_(trajectory), joints_(static_cast<std::size_t>(arm.dof())) {
  if (recover == 0 || trajectory.size() == 0) return;
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits& limits = arm.limits(i);
    const double start = trajectory.positions.front()[i];
    const double excess = excess_over(limits, start);
    if (!may_recover(excess, recover)) continue;
    Returning& returning = joints_[joint(i)];
    returning.above = start > limits.upper;
    double smallest = excess;
    // The last sample must be within the limits.
    for (std::size_t k = 0; k + 1 < trajectory.size(); ++k) {
      const double q = trajectory.positions[k][i];
      const double here = returning.above ? q - limits.upper : limits.lower - q;
      if (here <= position_slack) break;
      smallest = std::min(smallest, here);
      returning.smallest.push_back(smallest);
    }
  }
}

Limits RecoveryCheck::limits(std::size_t k, int i) const {
  Limits limits = arm_.limits(i);
  if (!is_returning(k, i)) return limits;
  (joints_[joint(i)].above ? limits.upper : limits.lower) =
      joints_[joint(i)].above ? Limits::none : -Limits::none;
  return limits;
}

double RecoveryCheck::rise(std::size_t k, int i) const {
  const Returning& returning = joints_[joint(i)];
  const Limits& limits = arm_.limits(i);
  Polynomial e = interval_polynomial(trajectory_, k, i);
  if (!returning.above) {
    for (double& c : e.c) c = -c;
  }
  e.c[0] += returning.above ? -limits.upper : limits.lower;
  return largest_rise(e, returning.smallest[k]);
}

}  // namespace beeline::internal
