#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/trajectory/limit_usage.h>

namespace beeline {
namespace {

using Columns = std::vector<Configuration>;

constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

double limit_of(const Arm& arm, int i, double Limits::*kind) {
  const Limits& limits = arm.limits(i);
  return kind == &Limits::velocity ? velocity_limit_of(limits) : limits.*kind;
}

/// The largest fraction of one kind of limit: of the values, and of the difference quotients of
/// `integral`, whose derivative they are.
LimitFraction largest_fraction(const Arm& arm, const std::vector<double>& t, const Columns& values,
                               const Columns& integral, double Limits::*kind) {
  LimitFraction largest;
  const auto take = [&](double fraction, int i, double time) {
    if (fraction > largest.fraction) largest = {fraction, arm.joint_of(i).name, time};
  };
  for (int i = 0; i < arm.dof(); ++i) {
    const double limit = limit_of(arm, i, kind);
    for (std::size_t k = 0; k < values.size(); ++k) take(std::abs(values[k][i]) / limit, i, t[k]);
    for (std::size_t k = 1; k < integral.size(); ++k) {
      const double before = integral[k - 1][i], after = integral[k][i];
      const double lost = rounding * std::max(std::abs(before), std::abs(after));
      const double dt = t[k] - t[k - 1] + rounding * std::abs(t[k]);
      take((std::abs(after - before) - lost) / dt / limit, i, t[k - 1]);
    }
  }
  return largest;
}

}  // namespace

LimitUsage limit_usage(const Arm& arm, const Trajectory& trajectory) {
  const auto [names, t, q, v, a] = matched_to(arm, trajectory);
  return {largest_fraction(arm, t, v, q, &Limits::velocity),
          largest_fraction(arm, t, a, v, &Limits::acceleration),
          largest_fraction(arm, t, {}, a, &Limits::jerk)};
}

double slowdown(double velocity, double acceleration, double jerk) {
  return std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)});
}

void slow_down(Trajectory& trajectory, double k) {
  if (!(k > 1)) return;
  for (double& t : trajectory.times) t *= k;
  for (Configuration& v : trajectory.velocities) v /= k;
  for (Configuration& a : trajectory.accelerations) a /= k * k;
}

}  // namespace beeline
