#include <Eigen/Geometry>
#include <cmath>

#include <beeline/pose/so3.h>

namespace beeline {

Eigen::Matrix3d hat(const Vector3& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

Rotation so3_exp(const Vector3& rotation_vector) {
  const double angle = rotation_vector.norm();
  // sin(t)/t and (1-cos t)/t^2 = (sin(t/2)/(t/2))^2/2 lose no digits; below 1e-8 both are 1, 1/2.
  const bool tiny = angle < 1e-8;
  const double sinc = tiny ? 1 : std::sin(angle) / angle;
  const double half = tiny ? 1 : std::sin(angle / 2) / (angle / 2);
  const Eigen::Matrix3d w = hat(rotation_vector);
  return Rotation::Identity() + sinc * w + (half * half / 2) * w * w;
}

Vector3 so3_log(const Rotation& rotation) {
  Eigen::Quaterniond q(rotation);  // picks the largest component: safe near pi
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double length = q.vec().norm();
  if (length < 1e-10) return 2 * q.vec();  // w is 1 here
  return (2 * std::atan2(length, q.w()) / length) * q.vec();
}

}  // namespace beeline
