#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/recovery.h>
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

double slight_excess(const Arm& arm) {
  constexpr double fraction = 1e-4;
  double range = Limits::none;
  for (int k = 0; k < arm.dof(); ++k) {
    range = std::min(range, arm.limits(k).upper - arm.limits(k).lower);
  }
  return range < Limits::none ? std::min(fraction * range, max_recover) : 0;
}

Configuration nearest_within_limits(const Arm& arm, const ConfigurationRef& q) {
  check_configuration(arm, q);
  Configuration nearest = q;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    nearest[k] = std::max(limits.lower, std::min(q[k], limits.upper));
  }
  return nearest;
}

std::size_t begin_of_path(const std::optional<Recovery>& recovery) {
  return recovery ? recovery->sample : 0;
}

std::optional<Recovery> recovery_of(const Arm& arm, const Trajectory& given) {
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) return std::nullopt;
  Recovery recovery;
  std::vector<int> outside;
  for (int k = 0; k < arm.dof(); ++k) {
    const double excess = internal::excess_over(arm.limits(k), trajectory.positions.front()[k]);
    if (!(excess > position_slack)) continue;
    outside.push_back(k);
    if (excess <= recovery.excess) continue;
    recovery.excess = excess;
    recovery.joint = arm.joint_of(k).name;
  }
  if (outside.empty()) return std::nullopt;
  const auto is_back = [&](const Configuration& q) {
    return std::all_of(outside.begin(), outside.end(), [&](int k) {
      return internal::excess_over(arm.limits(k), q[k]) <= position_slack;
    });
  };
  while (recovery.sample + 1 < trajectory.size() &&
         !is_back(trajectory.positions[recovery.sample])) {
    ++recovery.sample;
  }
  recovery.time = trajectory.times[recovery.sample];
  return recovery;
}

std::optional<Recovery> accepted_recovery(const Arm& arm, const Trajectory& trajectory,
                                          double recover) {
  internal::check_recover(recover);
  std::optional<Recovery> recovery = recovery_of(arm, trajectory);
  if (recovery && !internal::may_recover(recovery->excess, recover)) recovery.reset();
  return recovery;
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
