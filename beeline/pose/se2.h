#pragma once

#include <iosfwd>

#include <beeline/pose/se3.h>

namespace beeline {

/// A planar pose as in Dellaert, *Serial Link Manipulators*. `a * b` composes two.
struct Pose2 {
  double x = 0;      ///< metres
  double y = 0;      ///< metres
  double theta = 0;  ///< radians
};

/// A planar twist [vx vy w], metres and radians.
using Twist2 = Eigen::Vector3d;

/// The exponential of SE(2), and its logarithm with theta in [-pi, pi] (Lynch & Park, "Modern
/// Robotics", 2017, section 3.3.3, in the plane).
Pose2 se2_exp(const Twist2& twist);
Twist2 se2_log(const Pose2& pose);

Pose2 operator*(const Pose2& a_T_b, const Pose2& b_T_c);
Pose2 inverse(const Pose2& pose);

/// The error E of the chapter's section 1.8: [x_to - x_from, y_to - y_from, theta_to ⊖ theta_from].
Twist2 pose_difference(const Pose2& to, const Pose2& from);

/// Returns the planar pose as a spatial one in the plane z = `height` (metres); and the planar part
/// of a spatial pose, without its height and tilt.
Pose to_space(const Pose2& pose, double height = 0);
Pose2 to_plane(const Pose& pose);

/// Prints `x 2.4, y 6.3 m, theta 0 rad`.
std::ostream& operator<<(std::ostream& out, const Pose2& pose);

}  // namespace beeline
