#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The velocity that a Jacobian maps to, and its axes. The linear rows always come first. Brackets
/// contain the names in the Robotics Toolbox, in Pinocchio, and in Lynch & Park. `base` means the
/// axes of the world, in which Arm::base() places link 0, and not the axes of link 0; the two
/// differ if Arm::base() rotates the arm. The Robotics Toolbox uses the word in the same sense.
enum class Frame {
  base,   ///< velocity of the tool's origin, in the world's axes (jacob0, LOCAL_WORLD_ALIGNED)
  tool,   ///< velocity of the tool's origin, in the tool's axes (jacobe, LOCAL, body)
  space,  ///< velocity of the tool's point at the world's origin, in world axes (WORLD, space)
};
std::string name(Frame frame);
Frame frame_named(std::string_view name);  ///< Throws Error for an unknown name.

/// 6 x dof: rows [vx vy vz wx wy wz], one column for each coordinate (Dellaert, *Serial Link
/// Manipulators*, eq. 1.4), in m and rad per unit of the coordinate.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Returns the Jacobian at q, which may be outside its limits. Throws Error when q does not have
/// arm.dof() finite values.
Jacobian jacobian(const Arm& arm, const ConfigurationRef& q, Frame frame = Frame::base);

/// The same into the caller's 6 x dof matrix, without allocation. Returns world_T_tool. Throws
/// Error for a matrix of another size.
Pose jacobian(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns,
              Frame frame = Frame::base);

/// Returns the joint torques (N m; forces, N, of prismatic joints) that balance a wrench by which
/// the tool acts on its surroundings: tau = J^T F (Lynch & Park, eq. 5.26). `wrench` is [force
/// moment], N and N m, in the axes of the frame, its moment about the frame's point. Nothing else
/// acts on the arm: no gravity, no friction. Throws Error as jacobian() does, and for a wrench that
/// is not finite.
Configuration joint_torques(const Arm& arm, const ConfigurationRef& q, const Twist& wrench,
                            Frame frame = Frame::base);

/// The 3 x dof Jacobian of a planar arm as in the chapter: rows [x y theta], in the world's axes.
/// The third row is exactly 1 for a revolute joint about z. Throws Error when the arm is not
/// planar.
Eigen::Matrix3Xd planar_jacobian(const Arm& arm, const ConfigurationRef& q);

/// Coordinates of the tool's orientation in the world.
enum class OrientationCoordinates {
  roll_pitch_yaw,   ///< roll, pitch, yaw of RollPitchYaw, rad
  quaternion,       ///< qw, qx, qy, qz of Quaternion, qw >= 0
  rotation_vector,  ///< rx, ry, rz of so3_log(), rad
};
std::string name(OrientationCoordinates coordinates);  ///< rpy, quaternion, rotation-vector
std::vector<std::string> orientation_coordinates_names();

/// Throws Error listing the names for another name.
OrientationCoordinates orientation_coordinates_named(std::string_view name);

/// Returns the names of the rows of analytical_jacobian(): x, y, z, then the orientation
/// coordinates.
std::vector<std::string> row_names(OrientationCoordinates coordinates);

/// Returns the analytical Jacobian, 6 x dof, or 7 x dof for quaternions: the derivatives of the
/// position of the tool's origin (metres) and of the coordinates of its orientation, both in the
/// world, with respect to q (Siciliano, Sciavicco, Villani, Oriolo, *Robotics*, 2009, section 3.6).
///
/// Throws Error if the coordinates have no derivatives, for roll_pitch_yaw at a pitch of +-90
/// degrees, and as jacobian() does. The rotation vector jumps at an angle of pi, the quaternion at
/// qw = 0; there the function returns the one-sided derivatives.
Eigen::MatrixXd analytical_jacobian(const Arm& arm, const ConfigurationRef& q,
                                    OrientationCoordinates coordinates);

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
