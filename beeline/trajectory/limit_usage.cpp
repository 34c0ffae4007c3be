#include <algorithm>
#include <cmath>

#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

LimitUsage limit_usage(const Arm& arm, const Trajectory& given, const Budget& budget) {
  internal::BudgetMeter meter(budget);
  const Trajectory trajectory = matched_to(arm, given);
  const std::vector<Limits> limits = internal::motion_limits_of(arm);
  const auto fraction = [&](int order, double Limits::*kind) {
    const internal::CoordinateFraction found =
        internal::limit_fraction(limits, trajectory, order, meter);
    LimitFraction result;
    result.exact = found.exact;
    if (!(found.fraction > 0)) return result;
    result.fraction = found.fraction;
    result.joint = arm.joint_of(found.coordinate).name;
    result.time = trajectory.times[found.sample];
    result.assumed = !(arm.limits(found.coordinate).*kind < Limits::none);
    return result;
  };
  const auto position = [&] {
    const internal::CoordinateFraction found = internal::range_fraction(limits, trajectory, meter);
    LimitFraction result;
    if (found.coordinate < 0) return result;
    result.fraction = found.fraction;
    result.joint = arm.joint_of(found.coordinate).name;
    result.time = trajectory.times[found.sample];
    return result;
  };
  LimitUsage usage{position(), fraction(1, &Limits::velocity), fraction(2, &Limits::acceleration),
                   fraction(3, &Limits::jerk)};
  usage.ending = meter.ending();
  return usage;
}

double slowdown_factor(double velocity, double acceleration, double jerk) {
  return std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)});
}

void slow_down(Trajectory& trajectory, double k) {
  if (!(k > 1)) return;
  for (double& t : trajectory.times) t *= k;
  for (Configuration& v : trajectory.velocities) v /= k;
  for (Configuration& a : trajectory.accelerations) a /= k * k;
}

}  // namespace beeline
