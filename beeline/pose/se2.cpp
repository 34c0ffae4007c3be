#include <cmath>
#include <ostream>

#include <beeline/error.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/so3.h>

namespace beeline {
namespace {

Eigen::Matrix2d rotation2(double theta) { return Eigen::Rotation2Dd(theta).toRotationMatrix(); }

/// V(theta), which maps the linear part of a planar twist to the translation of its exponential:
/// [sin(theta)/theta, -c; c, sin(theta)/theta] with c = (1 - cos theta)/theta.
Eigen::Matrix2d translation_map(double theta) {
  const double half = std::abs(theta) < 1e-8 ? 1 : std::sin(theta / 2) / (theta / 2);
  const double sinc = std::abs(theta) < 1e-8 ? 1 : std::sin(theta) / theta;
  const double c = half * half * theta / 2;
  return (Eigen::Matrix2d() << sinc, -c, c, sinc).finished();
}

}  // namespace

Pose2 se2_exp(const Twist2& twist) {
  const Eigen::Vector2d p = translation_map(twist.z()) * twist.head<2>();
  return {p.x(), p.y(), wrap_angle(twist.z())};
}

Twist2 se2_log(const Pose2& pose) {
  const double theta = wrap_angle(pose.theta);
  const Eigen::Vector2d v = translation_map(theta).inverse() * Eigen::Vector2d(pose.x, pose.y);
  return {v.x(), v.y(), theta};
}

Pose2 operator*(const Pose2& a_T_b, const Pose2& b_T_c) {
  const Eigen::Vector2d p = Eigen::Vector2d(a_T_b.x, a_T_b.y) +
                            rotation2(a_T_b.theta) * Eigen::Vector2d(b_T_c.x, b_T_c.y);
  return {p.x(), p.y(), wrap_angle(a_T_b.theta + b_T_c.theta)};
}

Pose2 inverse(const Pose2& pose) {
  const Eigen::Vector2d p = rotation2(-pose.theta) * Eigen::Vector2d(-pose.x, -pose.y);
  return {p.x(), p.y(), wrap_angle(-pose.theta)};
}

Twist2 pose_difference(const Pose2& to, const Pose2& from) {
  return {to.x - from.x, to.y - from.y, angle_difference(to.theta, from.theta)};
}

Pose to_space(const Pose2& pose, double height) {
  Pose space = Pose::Identity();
  space.linear().topLeftCorner<2, 2>() = rotation2(pose.theta);
  space.translation() << pose.x, pose.y, height;
  return space;
}

std::ostream& operator<<(std::ostream& out, const Pose2& pose) {
  return out << "x " << number(pose.x) << ", y " << number(pose.y) << " m, theta "
             << number(pose.theta) << " rad";
}

Pose2 to_plane(const Pose& pose) {
  return {pose.translation().x(), pose.translation().y(),
          std::atan2(pose.linear()(1, 0), pose.linear()(0, 0))};
}

}  // namespace beeline
