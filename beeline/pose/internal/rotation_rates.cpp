#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/pose/internal/rotation_rates.h>

namespace beeline {
namespace {

/// The factors of J, and their derivatives by a, divided by a.
struct Factors {
  double once, twice;
  double once_rate, twice_rate;
};

Factors factors(double a) {
  const double square = a * a;
  if (a > 1) {
    const double once = (1 - std::cos(a)) / square, twice = (a - std::sin(a)) / (square * a);
    return {once, twice, (std::sin(a) / a - 2 * once) / square, (once - 3 * twice) / square};
  }
  // sum (-1)^k a^2k / (2k + 2)! and / (2k + 3)!: the quotients would cancel
  Factors sums{0, 0, 0, 0};
  double term = 0.5, power = 1, before = 0;  // before: a^(2k - 2)
  for (int k = 0; k < 9; ++k) {
    sums.once += term * power;
    sums.twice += term * power / (2 * k + 3);
    sums.once_rate += 2 * k * term * before;
    sums.twice_rate += 2 * k * term * before / (2 * k + 3);
    before = power;
    power *= square;
    term /= -(2 * k + 3) * (2 * k + 4);
  }
  return sums;
}

Eigen::Matrix3d left_jacobian(const Vector3& r, const Factors& f) {
  return Eigen::Matrix3d::Identity() + f.once * hat(r) + f.twice * hat(r) * hat(r);
}

/// J' r'
Vector3 change(const Vector3& r, const Vector3& rate, const Factors& f) {
  const Vector3 across = r.cross(rate);
  return r.dot(rate) * (f.once_rate * across + f.twice_rate * r.cross(across)) +
         f.twice * rate.cross(across);
}

}  // namespace

Turning angular_motion(const Vector3& r, const Turning& rates) {
  const Factors f = factors(r.norm());
  const Eigen::Matrix3d j = left_jacobian(r, f);
  return {j * rates.velocity, j * rates.acceleration + change(r, rates.velocity, f)};
}

Turning rotation_vector_rates(const Vector3& r, const Turning& motion) {
  const Factors f = factors(r.norm());
  const Eigen::Matrix3d inverse = left_jacobian(r, f).inverse();
  const Vector3 rate = inverse * motion.velocity;
  return {rate, inverse * (motion.acceleration - change(r, rate, f))};
}

double swing_bound(double swing, double turned) {
  using std::numbers::inv_sqrtpi;
  using std::numbers::pi;
  if (!(turned < pi)) return pi;
  const double k = turned * inv_sqrtpi;
  return std::min(pi, swing / 8 * (k > 0 ? k / std::sin(k) : 1));
}

}  // namespace beeline
