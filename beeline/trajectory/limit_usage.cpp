#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/trajectory/limit_usage.h>

namespace beeline {
namespace {

using Columns = std::vector<Configuration>;

constexpr double epsilon = 4 * std::numeric_limits<double>::epsilon();

double limit_of(const Arm& arm, int i, double Limits::*kind) {
  const Limits& limits = arm.limits(i);
  return kind == &Limits::velocity ? held_velocity(limits) : limits.*kind;
}

/// Takes the values of one kind, and the differences of what they are the derivative of.
LimitFraction use(const Arm& arm, const std::vector<double>& t, const Columns& values,
                  const Columns& integral, double Limits::*kind) {
  LimitFraction most;
  const auto take = [&](double fraction, int i, double time) {
    if (fraction > most.fraction) most = {fraction, arm.joint_of(i).name, time};
  };
  for (int i = 0; i < arm.dof(); ++i) {
    const double limit = limit_of(arm, i, kind);
    for (std::size_t k = 0; k < values.size(); ++k) take(std::abs(values[k][i]) / limit, i, t[k]);
    for (std::size_t k = 1; k < integral.size(); ++k) {
      const double before = integral[k - 1][i], after = integral[k][i];
      const double lost = epsilon * std::max(std::abs(before), std::abs(after));
      const double dt = t[k] - t[k - 1] + epsilon * std::abs(t[k]);
      take((std::abs(after - before) - lost) / dt / limit, i, t[k - 1]);
    }
  }
  return most;
}

}  // namespace

LimitUsage limit_usage(const Trajectory& trajectory, const Arm& arm) {
  const auto [names, t, q, v, a] = matched_to(arm, trajectory);
  return {use(arm, t, v, q, &Limits::velocity), use(arm, t, a, v, &Limits::acceleration),
          use(arm, t, {}, a, &Limits::jerk)};
}

}  // namespace beeline
