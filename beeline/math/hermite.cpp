#include <algorithm>
#include <cmath>

#include <beeline/math/hermite.h>

namespace beeline::internal {

Cubic cubic_between(double from, double to, double velocity_from, double velocity_to,
                    double duration) {
  const double step = to - from, a = velocity_from * duration, b = velocity_to * duration;
  return {from, a, 3 * step - 2 * a - b, a + b - 2 * step, duration};
}

Extremes extremes(const Cubic& cubic) {
  const double ends[] = {cubic.value(0), cubic.value(1)};
  Extremes found{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
  const auto take = [&](double u) {
    if (!(u > 0 && u < 1)) return;
    found = {std::min(found.smallest, cubic.value(u)), std::max(found.largest, cubic.value(u))};
  };
  // 3 c3 u^2 + 2 c2 u + c1 = 0, without cancellation; a division by zero yields no u within the
  // step
  const double root = cubic.c2 * cubic.c2 - 3 * cubic.c1 * cubic.c3;
  if (!(root >= 0)) return found;
  const double q = -(cubic.c2 + std::copysign(std::sqrt(root), cubic.c2));
  take(q / (3 * cubic.c3));
  take(cubic.c1 / q);
  return found;
}

}  // namespace beeline::internal
