#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_motion.h>

namespace beeline::internal {

PoseMotion tool_motion(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                       const ConfigurationRef& ddq) {
  const std::vector<Pose> world_T_link = link_poses(arm, q);
  PoseMotion tool{.pose = world_T_link.back() * arm.tool()};
  Vector3 before = Vector3::Zero();  // angular velocity of the link before the joint
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const Twist column =
        joint_velocity(arm.joints()[i], world_T_link[i + 1], tool.pose.translation());
    const Twist velocity = coupling.ratio * dq[coupling.coordinate] * column;
    const Vector3 linear = velocity.head<3>(), angular = velocity.tail<3>();
    tool.velocity += velocity;
    tool.acceleration += coupling.ratio * ddq[coupling.coordinate] * column;
    // The column is w x r, with r from the joint's axis to the tool: w' = before x w, and of r' the
    // joints before contribute before x r, this one w x r, and those after it twice to `linear`.
    tool.acceleration.head<3>() += (2 * before + angular).cross(linear);
    tool.acceleration.tail<3>() += before.cross(angular);
    before += angular;
  }
  return tool;
}

PoseMotion tool_motion(const Arm& arm, std::span<const Polynomial> coordinates, double u) {
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  Configuration q(n), dq(n), ddq(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Polynomial& p = coordinates[static_cast<std::size_t>(k)];
    const Polynomial d = p.derivative();
    q[k] = p(u);
    dq[k] = d(u);
    ddq[k] = d.derivative()(u);
  }
  return tool_motion(arm, q, dq, ddq);
}

}  // namespace beeline::internal
