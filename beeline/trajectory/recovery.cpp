#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/trajectory/internal/motion_start.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline {

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

namespace internal {

void check_recover(double recover) {
  if (recover >= 0 && recover <= max_recover) return;
  throw Error("", "recover",
              " must be from 0 to " + number(max_recover) + " rad or m, not " + number(recover));
}

bool starts_outside(const Arm& arm, const ConfigurationRef& q, double recover, const char* option) {
  check_recover(recover);
  check_configuration(arm, q);
  if (may_recover(largest_excess(arm, q), recover)) return true;
  check_start(arm, q, option);
  return false;
}

double largest_excess(const Arm& arm, const ConfigurationRef& q) {
  double largest = -Limits::none;
  for (int k = 0; k < arm.dof(); ++k) {
    largest = std::max(largest, excess_over(arm.limits(k), q[k]));
  }
  return largest;
}

}  // namespace internal
}  // namespace beeline
