#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/timing/internal/s_curve_state.h>
#include <beeline/timing/point_to_point.h>

namespace beeline {
namespace {

[[noreturn]] void refuse(double distance, const Limits& limits) {
  if (!std::isfinite(distance)) {
    throw Error("the distance of a motion is " + number(distance) + "; it must be finite");
  }
  for (const double rate : {limits.velocity, limits.acceleration, limits.jerk}) {
    if (rate > 0) continue;
    throw Error("a velocity, acceleration or jerk limit is " + number(rate) +
                "; it must be above zero");
  }
  if (std::min({limits.velocity, limits.acceleration, limits.jerk}) == Limits::none) {
    throw Error("a motion needs a limit on velocity, acceleration or jerk; all three are infinite");
  }
  throw Error("a motion over " + number(distance) +
              " would take longer than a double can hold; its limits are too small");
}

}  // namespace

SCurve s_curve(double distance, const Limits& limits) {
  const double v = limits.velocity, a = limits.acceleration, j = limits.jerk;
  const double d = std::abs(distance);
  if (!(d < Limits::none && v > 0 && a > 0 && j > 0)) refuse(distance, limits);
  if (d == 0) return {};

  SCurve curve{.distance = distance, .velocity = v, .acceleration = a, .jerk = j};
  double& tj = curve.jerk_time;
  double& ta = curve.acceleration_time;
  const double to_limit = j == Limits::none ? 0 : a / j;  // time to the acceleration limit

  // Up to the velocity limit: v = j tj (tj + ta), over the distance v (2 tj + ta) in both ramps.
  if (v / a >= to_limit) {
    tj = to_limit;
    ta = v / a - to_limit;
  } else {  // also where v and a are both infinite
    tj = std::sqrt(v / j);
    curve.acceleration = j * tj;
  }
  const double both_ramps = v * (2 * tj + ta);
  if (d >= both_ramps) {
    curve.cruise_time = (d - both_ramps) / v;
  } else if (d / a < 2 * to_limit * to_limit) {  // d = 2 j tj^3
    tj = std::cbrt(d / j / 2);
    ta = 0;
    curve.acceleration = j * tj;
    curve.velocity = curve.acceleration * tj;
  } else {  // d = a (tj + ta) (2 tj + ta), solved for ta without cancellation
    tj = to_limit;
    const double root = std::sqrt(tj * tj + 4 * (d / a));
    const double tiny = std::numeric_limits<double>::min();  // where d / a underflows
    ta = 2 * (d / a - 2 * tj * tj) / std::max(root + 3 * tj, tiny);
    curve.acceleration = a;
    curve.velocity = a * (tj + ta);
  }
  curve.duration = 4 * tj + 2 * ta + curve.cruise_time;
  if (!(curve.duration < Limits::none && curve.velocity < Limits::none)) refuse(distance, limits);
  if (distance < 0) {
    curve.velocity = -curve.velocity;
    curve.acceleration = -curve.acceleration;
    curve.jerk = -curve.jerk;
  }
  return curve;
}

SCurve stretched(const SCurve& curve, double duration) {
  if (!(duration >= curve.duration && duration < Limits::none)) {
    throw Error("a motion of " + number(curve.duration) + " s cannot be stretched to " +
                number(duration) + " s");
  }
  SCurve slow = curve;
  slow.duration = duration;
  if (curve.duration == 0) return slow;
  const double slower = curve.duration / duration, longer = duration / curve.duration;
  slow.jerk_time *= longer;
  slow.acceleration_time *= longer;
  slow.cruise_time *= longer;
  slow.velocity *= slower;
  slow.acceleration *= slower * slower;
  slow.jerk *= slower * slower * slower;
  return slow;
}

JointState at(const SCurve& curve, double t) {
  if (std::isnan(t)) throw Error("the time at which a motion is evaluated is NaN");
  if (t <= 0) return {};
  if (t >= curve.duration) return {curve.distance, 0, 0, 0};
  if (t <= curve.duration / 2) return internal::first_half_state(curve, t);
  JointState state = internal::first_half_state(curve, curve.duration - t);
  state.position = curve.distance - state.position;
  state.acceleration = -state.acceleration;
  return state;
}

}  // namespace beeline
