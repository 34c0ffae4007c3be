#include <cmath>

#include <beeline/model/internal/periodic_coordinate.h>

namespace beeline::internal {

bool is_periodic(const Arm& arm, int k) {
  if (static_cast<std::size_t>(arm.dof()) == arm.joints().size()) {  // no mimic joints
    return kind(arm.joints()[static_cast<std::size_t>(k)]) == JointKind::revolute;
  }
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    if (coupling.coordinate != k || coupling.ratio == 0) continue;
    const bool whole = coupling.ratio == std::round(coupling.ratio);
    if (!whole || kind(arm.joints()[i]) != JointKind::revolute) return false;
  }
  return true;
}

}  // namespace beeline::internal
