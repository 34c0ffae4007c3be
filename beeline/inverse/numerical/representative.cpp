#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/revolution.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

// Max distance outside a limit at which a solution is clamped to the limit, radians or metres: ten
// times the default tolerance of a solution.
constexpr double rounding = 1e-9;

}  // namespace

double nearest_angle_within(double angle, double reference, double lower, double upper,
                            double slack) {
  const double nearest = nearest_angle(angle, std::clamp(reference, lower, upper));
  if (nearest < lower - slack) {
    const double raised = nearest + revolution;
    return raised - upper < lower - nearest ? raised : nearest;
  }
  if (nearest > upper + slack) {
    const double lowered = nearest - revolution;
    return lower - lowered < nearest - upper ? lowered : nearest;
  }
  return nearest;
}

void move_to_nearest(const Arm& arm, const ConfigurationRef& reference, const Bounds& bounds,
                     Configuration& q) {
  for (int k = 0; k < arm.dof(); ++k) {
    const double lower = bounds.lower[k], upper = bounds.upper[k];
    if (arm.periodic(k)) q[k] = nearest_angle_within(q[k], reference[k], lower, upper, rounding);
    const double on_bound = std::clamp(q[k], lower, upper);
    if (std::abs(on_bound - q[k]) <= rounding) q[k] = on_bound;
  }
}

Configuration nearest_representative(const Arm& arm, const ConfigurationRef& q,
                                     const ConfigurationRef& reference, const Bounds& bounds) {
  Configuration moved = q;
  move_to_nearest(arm, reference, bounds, moved);
  return moved;
}

std::vector<Configuration> every_representative(const Arm& arm,
                                                const std::vector<Configuration>& postures,
                                                const Bounds& bounds) {
  constexpr std::size_t max_count =
      100'000;  // bounds the memory: the number grows as a power of the dof
  std::vector<Configuration> all = postures;
  for (int k = 0; k < arm.dof(); ++k) {
    const double lower = bounds.lower[k], upper = bounds.upper[k];
    if (!arm.periodic(k) || !std::isfinite(lower) || !std::isfinite(upper)) continue;
    std::vector<Configuration> result;
    for (const Configuration& q : all) {
      const double first = std::ceil((lower - rounding - q[k]) / revolution);
      for (double revolutions = first; q[k] + revolutions * revolution <= upper + rounding;
           ++revolutions) {
        if (result.size() == max_count) {
          throw Error("arm " + arm.name() +
                      " has more than 100000 equivalent configurations within limits");
        }
        result.push_back(q);
        result.back()[k] = std::clamp(q[k] + revolutions * revolution, lower, upper);
      }
    }
    all = result;
  }
  return all;
}

bool same_posture(const Arm& arm, const Configuration& a, const Configuration& b,
                  double tolerance) {
  for (int k = 0; k < arm.dof(); ++k) {
    const double apart = arm.periodic(k) ? angle_difference(a[k], b[k]) : a[k] - b[k];
    if (!(std::abs(apart) <= tolerance)) return false;
  }
  return true;
}

}  // namespace beeline::internal
