#include <beeline/error.h>
#include <beeline/inverse/internal/joint_lock.h>

namespace beeline::internal {

Arm with_locked(const Arm& arm, int k, double value) {
  if (arm.dof() < 2) throw Error("arm " + arm.name() + " has one joint, which cannot be locked");
  std::vector<Joint> joints;
  Pose fixed = Pose::Identity();  // the product of the fixed joints since the last moving joint
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    if (coupling.coordinate == k) {
      fixed = fixed * joint_transform(joint, coupling.ratio * value + coupling.shift);
      continue;
    }
    joints.push_back(joint);
    joints.back().offset = fixed * joint.offset;
    fixed = Pose::Identity();
  }
  return {arm.name(), joints, fixed * arm.tool(), arm.base()};
}

Configuration without(const Configuration& q, int k) {
  Configuration shorter(q.size() - 1);
  shorter << q.head(k), q.tail(q.size() - 1 - k);
  return shorter;
}

Configuration with(const Configuration& q, int k, double value) {
  Configuration longer(q.size() + 1);
  longer << q.head(k), value, q.tail(q.size() - k);
  return longer;
}

}  // namespace beeline::internal
