#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/forward_kernel.h>

namespace beeline {
namespace {

Pose link_transform(const Arm& arm, std::size_t i, const ConfigurationRef& q) {
  const Arm::JointCoupling& coupling = arm.couplings()[i];
  return joint_transform(arm.joints()[i], coupling.ratio * q[coupling.coordinate] + coupling.shift);
}

}  // namespace

Pose forward_kinematics(const Arm& arm, const ConfigurationRef& q) {
  if (q.size() != arm.dof()) check_configuration(arm, q);
  Pose world_T_tool;
  internal::forward_kernel(arm, q.data(), world_T_tool.data());
  if (!std::isfinite(world_T_tool.matrix().sum())) check_configuration(arm, q);
  return world_T_tool;
}

Pose pose_in_plane(const Arm& arm, const Pose2& pose) {
  if (!arm.planar()) {
    throw Error("x,y,theta is for planar arms; a pose of " + arm.name() + " is spatial");
  }
  const Pose any = forward_kinematics(arm, middle_configuration(arm));
  return to_space(pose, any.translation().z());
}

void link_poses(const Arm& arm, const ConfigurationRef& q, std::span<Pose> world_T_link) {
  check_configuration(arm, q);
  if (world_T_link.size() != arm.joints().size() + 1) {
    throw Error("link_poses needs a buffer of " + std::to_string(arm.joints().size() + 1) +
                " poses, not " + std::to_string(world_T_link.size()));
  }
  world_T_link[0] = arm.base();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    world_T_link[i + 1] = world_T_link[i] * link_transform(arm, i, q);
  }
}

std::vector<Pose> link_poses(const Arm& arm, const ConfigurationRef& q) {
  std::vector<Pose> world_T_link(arm.joints().size() + 1);
  link_poses(arm, q, world_T_link);
  return world_T_link;
}

}  // namespace beeline
