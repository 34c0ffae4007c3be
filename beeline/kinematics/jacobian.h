#pragma once

#include <string>
#include <string_view>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The velocity that a Jacobian maps to, and its axes. The linear rows always come first. In
/// brackets the names of the Robotics Toolbox, of Pinocchio, and of Lynch & Park. The axes of
/// `base` are those of the world, in which Arm::base() places link 0, not those of link 0: the two
/// differ where Arm::base() rotates the arm. The Robotics Toolbox uses the word in the same sense.
enum class Frame {
  base,   ///< of the tool's origin, in the world's axes (jacob0, LOCAL_WORLD_ALIGNED)
  tool,   ///< of the tool's origin, in the tool's axes (jacobe, LOCAL, body)
  space,  ///< of the point of the tool at the world's origin, in the world's axes (WORLD, space)
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

}  // namespace beeline
