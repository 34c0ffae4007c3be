#pragma once

#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// 6 x (dof dof): the second derivatives of the tool's motion. Block k, the columns k dof to
/// k dof + dof - 1, is the derivative of the Jacobian with respect to coordinate k, per radian or
/// metre of it.
using Hessian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Returns the time derivative of the Jacobian of a frame, 6 x dof, per second, at configuration q
/// with joint velocities dq, rad/s or m/s. The velocity of the frame is J dq, its time derivative
/// J ddq + J' dq.
///
/// The columns of a rigid chain give their own derivatives: joint k before joint i moves column i
/// rigidly, joint k after it moves the tool's origin only (Bruyninckx and De Schutter, "Symbolic
/// differentiation of the velocity mapping for a serial kinematic chain", Mechanism and Machine
/// Theory 31(2), 1996). Throws Error when q or dq does not have arm.dof() finite values.
Jacobian jacobian_derivative(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                             Frame frame = Frame::base);

/// The same into the caller's 6 x dof matrix, without allocation unless the arm has mimic joints.
/// Returns world_T_tool. Throws Error for a matrix of another size.
Pose jacobian_derivative(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                         Eigen::Ref<Jacobian> derivative, Frame frame = Frame::base);

/// Returns the derivatives of the Jacobian of a frame with respect to the coordinates. Throws Error
/// as jacobian() does.
Hessian hessian(const Arm& arm, const ConfigurationRef& q, Frame frame = Frame::base);

/// The same into the caller's matrices, the Jacobian too, without allocation unless the arm has
/// mimic joints. Returns world_T_tool. Throws Error for matrices of another size.
Pose hessian(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns,
             Eigen::Ref<Hessian> derivatives, Frame frame = Frame::base);

/// Returns the time derivative of the velocity J dq of a frame, J ddq + J' dq, [linear angular] in
/// m/s^2 and rad/s^2, without allocation for arms of up to 16 coordinates without mimic joints. In
/// the base frame it is the acceleration of the tool's origin and the angular acceleration, in the
/// world's axes; in the others, whose axes or point move, the derivative of the components. Throws
/// Error when q, dq or ddq does not have arm.dof() finite values.
Twist tool_acceleration(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                        const ConfigurationRef& ddq, Frame frame = Frame::base);

}  // namespace beeline
