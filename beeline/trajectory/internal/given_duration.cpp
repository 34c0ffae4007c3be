#include <cmath>

#include <beeline/error.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {

void check_duration(const std::optional<double>& duration) {
  if (!duration || (*duration > 0 && std::isfinite(*duration))) return;
  throw Error::of("duration", "duration must be above 0 s, not " + number(*duration));
}

void refuse_duration_with_rate(const std::optional<double>& duration, double rate) {
  if (duration && rate > 0) {
    throw Error("duration cannot be combined with a rate, at which sections last whole periods");
  }
}

Reason too_short(double duration, double shortest) {
  return {ReasonCode::duration_too_short,
          {{ReasonField::duration, duration}, {ReasonField::shortest_duration, shortest}}};
}

Reason set_duration(Trajectory& trajectory, double duration) {
  constexpr double rounding = 1e-9;  // seconds
  const double shortest = trajectory.times.back();
  if (duration < shortest - rounding) return too_short(duration, shortest);
  slow_down(trajectory, duration / shortest);
  round_times(trajectory);
  return {};
}

}  // namespace beeline::internal
