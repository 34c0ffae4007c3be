#pragma once

#include <string>
#include <string_view>

#include <beeline/model/arm.h>

namespace beeline {

/// Which velocity a Jacobian gives, and in which axes. All rows are linear first.
enum class Frame {
  base,   ///< of the tool's origin, in the world's axes (jacob0, LOCAL_WORLD_ALIGNED); the default
  tool,   ///< of the tool's origin, in the tool's axes (jacobe, LOCAL, body)
  space,  ///< spatial twist: of the point of the tool that is at the world's origin (WORLD)
};
std::string name(Frame frame);
Frame frame_named(std::string_view name);  ///< throws Error for another name

/// 6 x dof: rows [vx vy vz wx wy wz], one column for each coordinate (the chapter's eq. 1.4).
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The Jacobian at any finite q. Throws Error when q does not fit the arm.
Jacobian jacobian(const Arm& arm, const ConfigurationRef& q, Frame frame = Frame::base);

/// The same into the caller's 6 x dof matrix, with the tool's pose as the result. Does not
/// allocate.
Pose jacobian(const Arm& arm, const ConfigurationRef& q, Eigen::Ref<Jacobian> columns,
              Frame frame = Frame::base);

/// The chapter's 3 x n form of a planar arm: rows [x y theta] in the world's axes; the third row is
/// exactly 1 for a revolute joint about z. Throws Error when the arm is not planar.
Eigen::Matrix3Xd planar_jacobian(const Arm& arm, const ConfigurationRef& q);

}  // namespace beeline
