#include <algorithm>

#include <beeline/planning/internal/inset_limits.h>

namespace beeline::internal {

Arm with_inset_limits(const Arm& arm, const std::optional<Configuration>& start, double inset) {
  std::vector<Joint> joints = arm.joints();
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const double width = std::min(inset, 0.05 * (limits.upper - limits.lower));
    Limits& reduced = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
                        return joint.name == arm.joint_of(k).name;
                      })->limits;
    reduced.lower = limits.lower + width;
    reduced.upper = limits.upper - width;
    if (!start) continue;
    reduced.lower = std::min(reduced.lower, (*start)[k]);
    reduced.upper = std::max(reduced.upper, (*start)[k]);
  }
  return {arm.name(), joints, arm.tool(), arm.base(), arm.controller()};
}

}  // namespace beeline::internal
