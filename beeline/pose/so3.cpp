#include <Eigen/Geometry>
#include <cmath>

#include <beeline/math/revolution.h>
#include <beeline/pose/so3.h>

namespace beeline {
namespace {

// Each quotient cancels near zero. Below this angle a series is used, with enough terms for an
// error under 1e-16.
constexpr double small_angle = 0.1;

/// (a - sin a) / a^3
double cubic_quotient(double a) {
  const double a2 = a * a;
  if (a > small_angle) return (a - std::sin(a)) / (a2 * a);
  return 1.0 / 6 - a2 / 120 * (1 - a2 / 42 * (1 - a2 / 72 * (1 - a2 / 110)));
}

/// (1 - (a/2) cot(a/2)) / a^2
double cotangent_quotient(double a) {
  const double a2 = a * a;
  if (a > small_angle) return (1 - (a / 2) / std::tan(a / 2)) / a2;
  return 1.0 / 12 + a2 / 720 * (1 + a2 / 42 * (1 + a2 / 40 * (1 + a2 * 5.0 / 198)));
}

}  // namespace

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

Eigen::Matrix3d so3_left_jacobian(const Vector3& r) {
  const double a = r.norm();
  const double half = a < 1e-8 ? 1 : std::sin(a / 2) / (a / 2);
  const Eigen::Matrix3d r_hat = hat(r);
  return Eigen::Matrix3d::Identity() + (half * half / 2) * r_hat +
         cubic_quotient(a) * r_hat * r_hat;
}

Eigen::Matrix3d so3_left_jacobian_inverse(const Vector3& r) {
  const Eigen::Matrix3d r_hat = hat(r);
  return Eigen::Matrix3d::Identity() - 0.5 * r_hat + cotangent_quotient(r.norm()) * r_hat * r_hat;
}

double wrap_angle(double radians) { return std::remainder(radians, internal::revolution); }

double angle_difference(double a, double b) {
  return wrap_angle(wrap_angle(a) - wrap_angle(b));  // a - b could overflow, or lose b to rounding
}

double nearest_angle(double radians, double reference) {
  using internal::revolution;
  return radians + revolution * std::nearbyint((reference - radians) / revolution);
}

}  // namespace beeline
