#include <algorithm>
#include <cmath>

#include <beeline/control/internal/velocity_bounds.h>

namespace beeline::internal {

std::string name(ServoLimit limit) {
  constexpr const char* names[] = {"none", "velocity", "acceleration", "position", "singular"};
  return names[static_cast<int>(limit)];
}

double fast_to_stop(double way, double acceleration, double time_step) {
  if (!(way > 0)) return 0;
  if (!std::isfinite(acceleration) || !std::isfinite(way)) return way / time_step;
  // v dt + v^2 / 2a = way, without cancellation
  return 2 * way / (time_step + std::sqrt(time_step * time_step + 2 * way / acceleration));
}

void fill_rooms(const Arm& arm, const internal::Bounds& bounds, const ConfigurationRef& q,
                double time_step, std::vector<Room>& rooms) {
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const Limits& limits = arm.limits(k);
    const double up = fast_to_stop(bounds.upper[k] - q[k], limits.acceleration, time_step);
    const double down = fast_to_stop(q[k] - bounds.lower[k], limits.acceleration, time_step);
    const auto kind = [&limits](double to_stop) {
      return to_stop < limits.velocity ? ServoLimit::position : ServoLimit::velocity;
    };
    rooms[k] = {-std::min(limits.velocity, down), std::min(limits.velocity, up), kind(down),
                kind(up)};
  }
}

}  // namespace beeline::internal
