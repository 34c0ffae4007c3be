#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/internal/forward_kernel.h>
#include <beeline/kinematics/internal/jacobian_frame.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/internal/chain.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<Frame> frame_names("frame");

/// For arms with mimic joints, whose columns are added to their leader's. Returns the tool's pose.
Pose joint_by_joint(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns) {
  columns.setZero();
  Pose world_T_link = arm.base(), world_T_tool;
  internal::forward_kernel(arm, q.data(), world_T_tool.data());
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    const Joint& joint = arm.joints()[i];
    world_T_link = world_T_link *
                   joint_transform(joint, coupling.ratio * q[coupling.coordinate] + coupling.shift);
    // The screw is the same in the link's frame before and after the motion.
    Twist velocity = joint_velocity(joint, world_T_link, world_T_tool.translation());
    if (arm.planar()) velocity.tail<3>() = velocity.tail<3>().array().round();
    columns.col(coupling.coordinate) += coupling.ratio * velocity;
  }
  return world_T_tool;
}

}  // namespace

std::string name(Frame frame) { return frame_names.of(frame); }

Frame frame_named(std::string_view name) {
  try {
    return frame_names.named(name);
  } catch (const Error& unknown) {
    throw Error(unknown.what() +
                std::string("; base and tool are the velocity of the tool's origin, in the "
                            "world's axes and in the tool's (the body Jacobian); space is the "
                            "velocity of the point at the world's origin, in the world's axes"));
  }
}

void internal::set_frame(Frame frame, const Pose& world_T_tool, Eigen::Ref<Jacobian> columns) {
  const Vector3 tool = world_T_tool.translation();
  for (int k = 0; frame == Frame::space && k < columns.cols(); ++k) {
    columns.col(k).head<3>() += tool.cross(columns.col(k).tail<3>());
  }
  for (int k = 0; frame == Frame::tool && k < columns.cols(); ++k) {
    const Vector3 v = columns.col(k).head<3>(), w = columns.col(k).tail<3>();
    columns.col(k) << world_T_tool.linear().transpose() * v, world_T_tool.linear().transpose() * w;
  }
}

Pose jacobian(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns,
              Frame frame) {
  if (q.size() != arm.dof()) check_configuration(arm, q);
  if (columns.cols() != arm.dof()) {
    throw Error("the Jacobian of arm " + arm.name() + " has " + std::to_string(arm.dof()) +
                " columns, not " + std::to_string(columns.cols()));
  }
  Pose world_T_tool;
  const bool contiguous = columns.outerStride() == 6;
  if (internal::chain_angles_of(arm).in_order && contiguous) {
    internal::jacobian_kernel(arm, q.data(), world_T_tool.data(), columns.data());
    if (!std::isfinite(world_T_tool.matrix().sum())) check_configuration(arm, q);
    // The axes of a planar arm are +-z: removes the rounding of the poses.
    if (arm.planar()) columns.bottomRows<3>() = columns.bottomRows<3>().array().round();
  } else {
    check_configuration(arm, q);
    world_T_tool = joint_by_joint(arm, q, columns);
  }
  internal::set_frame(frame, world_T_tool, columns);
  return world_T_tool;
}

Jacobian jacobian(const Arm& arm, const ConfigurationRef& q, Frame frame) {
  Jacobian columns(6, arm.dof());
  jacobian(arm, q, columns, frame);
  return columns;
}

Eigen::Matrix3Xd planar_jacobian(const Arm& arm, const ConfigurationRef& q) {
  if (!arm.planar()) {
    throw Error("arm " + arm.name() + " is not planar; its Jacobian has the six spatial rows");
  }
  const Jacobian spatial = jacobian(arm, q);
  Eigen::Matrix3Xd planar(3, arm.dof());
  planar << spatial.topRows<2>(), spatial.bottomRows<1>();
  return planar;
}

Configuration joint_torques(const Arm& arm, const ConfigurationRef& q, const Twist& wrench,
                            Frame frame) {
  if (!wrench.allFinite()) throw Error("the wrench must be finite");
  return jacobian(arm, q, frame).transpose() * wrench;
}

}  // namespace beeline
