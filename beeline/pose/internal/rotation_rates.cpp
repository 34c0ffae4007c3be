#include <Eigen/Geometry>
#include <cmath>

#include <beeline/pose/internal/rotation_rates.h>

namespace beeline::internal {
namespace {

/// The factors of J(r) = I + f [r] + g [r]^2 that its derivative needs: g, and f'(a)/a, g'(a)/a.
struct Factors {
  double g, f_rate, g_rate;
};

Factors factors(double a) {
  const double square = a * a;
  if (a > 1) {
    const double f = (1 - std::cos(a)) / square, g = (a - std::sin(a)) / (square * a);
    return {g, (std::sin(a) / a - 2 * f) / square, (f - 3 * g) / square};
  }
  // The quotients would cancel. f = sum (-1)^k a^2k / (2k + 2)!, g = sum (-1)^k a^2k / (2k + 3)!;
  // nine terms leave an error under 1e-17.
  Factors sums{0, 0, 0};
  double term = 0.5, power = 1, before = 0;  // before: a^(2k - 2)
  for (int k = 0; k < 9; ++k) {
    sums.g += term * power / (2 * k + 3);
    sums.f_rate += 2 * k * term * before;
    sums.g_rate += 2 * k * term * before / (2 * k + 3);
    before = power;
    power *= square;
    term /= -(2 * k + 3) * (2 * k + 4);
  }
  return sums;
}

/// J'(r) r'
Vector3 jacobian_rate_times(const Vector3& r, const Vector3& rate) {
  const Factors factor = factors(r.norm());
  const Vector3 cross = r.cross(rate);
  return r.dot(rate) * (factor.f_rate * cross + factor.g_rate * r.cross(cross)) +
         factor.g * rate.cross(cross);
}

}  // namespace

RotationRates angular_motion(const Vector3& r, const RotationRates& derivatives) {
  const Eigen::Matrix3d j = so3_left_jacobian(r);
  return {j * derivatives.velocity,
          j * derivatives.acceleration + jacobian_rate_times(r, derivatives.velocity)};
}

RotationRates rotation_vector_rates(const Vector3& r, const RotationRates& motion) {
  const Eigen::Matrix3d inverse = so3_left_jacobian_inverse(r);
  const Vector3 rate = inverse * motion.velocity;
  return {rate, inverse * (motion.acceleration - jacobian_rate_times(r, rate))};
}

}  // namespace beeline::internal
