#include <algorithm>

#include <beeline/model/arm.h>

namespace beeline {

bool same_joints(const Arm& a, const Arm& b) {
  const auto same_joint = [](const Joint& x, const Joint& y) {
    return x.offset.matrix() == y.offset.matrix() && x.screw == y.screw;
  };
  const auto same_coupling = [](const Arm::JointCoupling& x, const Arm::JointCoupling& y) {
    return x.coordinate == y.coordinate && x.ratio == y.ratio && x.shift == y.shift;
  };
  return std::equal(a.joints().begin(), a.joints().end(), b.joints().begin(), b.joints().end(),
                    same_joint) &&
         std::equal(a.couplings().begin(), a.couplings().end(), b.couplings().begin(),
                    b.couplings().end(), same_coupling);
}

bool same_links(const Arm& a, const Arm& b) {
  return a.base().matrix() == b.base().matrix() && same_joints(a, b);
}

}  // namespace beeline
