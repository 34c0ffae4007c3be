#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>

namespace beeline::internal {

TaylorBound taylor_bound(const Polynomial& p, double from, double to) {
  const bool whole = from == 0 && to == 1;
  TaylorBound bound;
  Polynomial derivative = p;
  double factorial = 1;
  for (std::size_t n = 0; n < Polynomial::terms; ++n) {
    if (n > 0) {
      derivative = derivative.derivative();
      factorial *= static_cast<double>(n);
    }
    const auto [smallest, largest] = enclosure(whole ? derivative : derivative.part(from, to));
    bound.c[n] = std::max(-smallest, largest) / factorial;
  }
  return bound;
}

ToolTaylorBound tool_taylor_bound(const Arm& arm, std::span<const Polynomial> coordinates) {
  Configuration middle(arm.dof());
  std::vector<TaylorBound> motion;
  for (int k = 0; k < arm.dof(); ++k) {
    middle[k] = coordinates[static_cast<std::size_t>(k)](0.5);
    motion.push_back(taylor_bound(coordinates[static_cast<std::size_t>(k)]));
  }
  const std::vector<Pose> world_T_link = link_poses(arm, middle);
  const Vector3 tool = (world_T_link.back() * arm.tool()).translation();
  TaylorBound position, rotation;
  for (std::size_t i = arm.joints().size(); i-- > 0;) {
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const TaylorBound joint =
        std::abs(coupling.ratio) * motion[static_cast<std::size_t>(coupling.coordinate)];
    const Twist velocity = joint_velocity(arm.joints()[i], world_T_link[i + 1], tool);
    const Vector3 linear = velocity.head<3>(), axis = velocity.tail<3>();
    const bool rotates = axis.squaredNorm() > 0.5;  // 0 or 1
    const double along = rotates ? std::abs(linear.dot(axis)) : linear.norm();
    if (rotates) {
      const double across = (linear - linear.dot(axis) * axis).norm();
      position.c[0] = across + position.c[1] / 2;
      position = exponential(joint) * position;
      rotation += joint;
    }
    position += along * joint;
  }
  return {position, exponential(rotation)};
}

}  // namespace beeline::internal
