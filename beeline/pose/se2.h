#pragma once

#include <beeline/pose/se3.h>

namespace beeline {

/// A pose in the plane, as the chapter writes it: metres, metres, radians.
struct Pose2 {
  double x = 0;
  double y = 0;
  double theta = 0;
};

/// A planar motion [vx vy w], by analogy to Twist.
using Twist2 = Eigen::Vector3d;

Pose2 se2_exp(const Twist2& twist);
Twist2 se2_log(const Pose2& pose);  ///< theta in [-pi, pi]

Pose2 operator*(const Pose2& a_T_b, const Pose2& b_T_c);
Pose2 inverse(const Pose2& pose);

/// The chapter's E (section 1.8): [x_to - x_from, y_to - y_from, theta_to ⊖ theta_from].
Twist2 pose_difference(const Pose2& to, const Pose2& from);

/// A planar pose as a pose in space, in the plane z = `height`, and back (z and tilt are dropped).
Pose to_space(const Pose2& pose, double height = 0);
Pose2 to_plane(const Pose& pose);

}  // namespace beeline
