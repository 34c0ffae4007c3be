#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/orientation_gap.h>

namespace beeline::internal {

double orientation_gap(double angular_acceleration, double rotation) {
  using std::numbers::inv_sqrtpi;
  using std::numbers::pi;
  if (!(rotation < pi)) return pi;
  const double k = rotation * inv_sqrtpi;
  return std::min(pi, angular_acceleration / 8 * (k > 0 ? k / std::sin(k) : 1));
}

}  // namespace beeline::internal
