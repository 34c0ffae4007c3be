#include <cmath>

#include <beeline/trajectory/internal/continuous_joint.h>

namespace beeline::internal {

bool is_continuous(const Arm& arm, int k) {
  const Limits& limits = arm.limits(k);
  if (limits.lower > -Limits::none || limits.upper < Limits::none) return false;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const auto& [coordinate, ratio, shift] = arm.drives()[i];
    if (coordinate != k) continue;
    if (kind(arm.joints()[i]) != JointKind::revolute || ratio != std::round(ratio)) return false;
  }
  return true;
}

}  // namespace beeline::internal
