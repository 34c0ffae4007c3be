#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/jacobian_frame.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/internal/mimic_joints.h>

namespace beeline {
namespace {

constexpr int stack_joints = 16;  // of tool_acceleration() without allocation

/// A column of the Jacobian in the base frame.
struct Column {
  Vector3 linear, angular;
};

Column column(const Eigen::Ref<const Jacobian>& columns, Eigen::Index i) {
  return {columns.col(i).head<3>(), columns.col(i).tail<3>()};
}

/// Returns the derivative of a column of the base frame, in a frame. `velocity` is the tool's
/// velocity and `change` the derivative of the column in the base frame, both for the same joint
/// velocities.
Twist in_frame(Frame frame, const Pose& world_T_tool, const Column& of, const Column& velocity,
               const Column& change) {
  Twist result;
  result << change.linear, change.angular;
  if (frame == Frame::space) {
    result.head<3>() +=
        velocity.linear.cross(of.angular) + world_T_tool.translation().cross(change.angular);
  } else if (frame == Frame::tool) {
    const auto tool_R_world = world_T_tool.linear().transpose();
    result.head<3>() = tool_R_world * (change.linear - velocity.angular.cross(of.linear));
    result.tail<3>() = tool_R_world * (change.angular - velocity.angular.cross(of.angular));
  }
  return result;
}

/// Replaces the columns of the base frame, one for each joint, by their time derivatives in
/// `frame`. rate(i) is the velocity of joint i.
template <class Rate>
void differentiate(const Pose& world_T_tool, Frame frame, const Rate& rate,
                   Eigen::Ref<Jacobian> columns) {
  Column tool{Vector3::Zero(), Vector3::Zero()};
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    tool.linear += rate(i) * columns.col(i).head<3>();
    tool.angular += rate(i) * columns.col(i).tail<3>();
  }
  Vector3 link = Vector3::Zero();  // the angular velocity of the link after joint i
  Vector3 after = tool.linear;     // the tool's velocity by the joints after joint i
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    const Column of = column(columns, i);
    link += rate(i) * of.angular;
    after -= rate(i) * of.linear;
    const Column change{link.cross(of.linear) + of.angular.cross(after), link.cross(of.angular)};
    columns.col(i) = in_frame(frame, world_T_tool, of, tool, change);
  }
}

/// The derivative of column i with respect to joint k.
Twist second_derivative(const Pose& world_T_tool, Frame frame,
                        const Eigen::Ref<const Jacobian>& columns, Eigen::Index i, Eigen::Index k) {
  const Column of = column(columns, i), by = column(columns, k);
  const Column change = k <= i ? Column{by.angular.cross(of.linear), by.angular.cross(of.angular)}
                               : Column{of.angular.cross(by.linear), Vector3::Zero()};
  return in_frame(frame, world_T_tool, of, by, change);
}

/// Writes a column of the base frame for each joint, mimic joints too. Returns world_T_tool.
Pose joint_columns(const Arm& arm, const ConfigurationRef& q, Jacobian& columns) {
  const std::vector<Pose> world_T_link = link_poses(arm, q);
  const Pose world_T_tool = world_T_link.back() * arm.tool();
  columns.resize(6, static_cast<Eigen::Index>(arm.joints().size()));
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) =
        joint_velocity(arm.joints()[i], world_T_link[i + 1], world_T_tool.translation());
  }
  return world_T_tool;
}

void check_columns(const Arm& arm, const char* what, Eigen::Index columns, Eigen::Index wanted) {
  if (columns == wanted) return;
  throw Error("the " + std::string(what) + " of arm " + arm.name() + " has " +
              std::to_string(wanted) + " columns, not " + std::to_string(columns));
}

}  // namespace

Pose jacobian_derivative(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                         Eigen::Ref<Jacobian> derivative, Frame frame) {
  check_configuration(arm, dq);
  check_columns(arm, "Jacobian", derivative.cols(), arm.dof());
  if (!internal::has_mimic_joints(arm)) {
    const Pose world_T_tool = jacobian(arm, q, derivative);
    differentiate(
        world_T_tool, frame, [&](Eigen::Index i) { return dq[i]; }, derivative);
    return world_T_tool;
  }
  check_configuration(arm, q);
  const auto coupling = [&](Eigen::Index i) {
    return arm.couplings()[static_cast<std::size_t>(i)];
  };
  Jacobian columns;
  const Pose world_T_tool = joint_columns(arm, q, columns);
  const auto rate = [&](Eigen::Index i) { return coupling(i).ratio * dq[coupling(i).coordinate]; };
  differentiate(world_T_tool, frame, rate, columns);
  derivative.setZero();
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    derivative.col(coupling(i).coordinate) += coupling(i).ratio * columns.col(i);
  }
  return world_T_tool;
}

Jacobian jacobian_derivative(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                             Frame frame) {
  Jacobian derivative(6, arm.dof());
  jacobian_derivative(arm, q, dq, derivative, frame);
  return derivative;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): Eigen::Ref is a reference that writes
Pose hessian(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns,
             Eigen::Ref<Hessian> derivatives, Frame frame) {
  const Eigen::Index n = arm.dof();
  check_columns(arm, "Hessian", derivatives.cols(), n * n);
  const Pose world_T_tool = jacobian(arm, q, columns);
  if (!internal::has_mimic_joints(arm)) {
    for (Eigen::Index k = 0; k < n; ++k) {
      for (Eigen::Index i = 0; i < n; ++i) {
        derivatives.col(k * n + i) = second_derivative(world_T_tool, frame, columns, i, k);
      }
    }
    internal::set_frame(frame, world_T_tool, columns);
    return world_T_tool;
  }
  Jacobian joints;
  joint_columns(arm, q, joints);
  derivatives.setZero();
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    for (Eigen::Index i = 0; i < joints.cols(); ++i) {
      const Arm::JointCoupling &of = arm.couplings()[static_cast<std::size_t>(i)],
                               &by = arm.couplings()[static_cast<std::size_t>(k)];
      derivatives.col(by.coordinate * n + of.coordinate) +=
          of.ratio * by.ratio * second_derivative(world_T_tool, frame, joints, i, k);
    }
  }
  internal::set_frame(frame, world_T_tool, columns);
  return world_T_tool;
}

Hessian hessian(const Arm& arm, const ConfigurationRef& q, Frame frame) {
  Jacobian columns(6, arm.dof());
  Hessian derivatives(6, Eigen::Index{arm.dof()} * arm.dof());
  hessian(arm, q, columns, derivatives, frame);
  return derivatives;
}

Twist tool_acceleration(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                        const ConfigurationRef& ddq, Frame frame) {
  check_configuration(arm, ddq);
  const auto acceleration = [&](auto columns) -> Twist {
    columns.resize(Eigen::NoChange, arm.dof());
    jacobian(arm, q, columns, frame);
    const Twist direct = columns * ddq;
    jacobian_derivative(arm, q, dq, columns, frame);
    return direct + columns * dq;
  };
  using OnStack = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, stack_joints>;
  return arm.dof() <= stack_joints ? acceleration(OnStack()) : acceleration(Jacobian());
}

}  // namespace beeline
