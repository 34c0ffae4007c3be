#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/math/hermite.h>
#include <beeline/record/internal/setpoints.h>

namespace beeline::internal {
namespace {

constexpr double max_setpoints = 1e7;

/// The joints at one time of the motion that the columns mean.
struct MotionState {
  Configuration position, velocity, acceleration;
};

/// The motion between samples k - 1 and k at u from 0 to 1: of degree 5, 3 or 1.
MotionState state_between(const Trajectory& trajectory, std::size_t k, double u) {
  const double h = trajectory.times[k] - trajectory.times[k - 1];
  const Configuration& from = trajectory.positions[k - 1];
  const Configuration change = trajectory.positions[k] - from;
  if (trajectory.velocities.empty()) return {from + u * change, change / h, 0 * change};
  const Configuration d0 = h * trajectory.velocities[k - 1], d1 = h * trajectory.velocities[k];
  Configuration dd0 = 6 * change - 4 * d0 - 2 * d1, dd1 = -6 * change + 2 * d0 + 4 * d1;  // cubic
  if (!trajectory.accelerations.empty()) {
    dd0 = h * h * trajectory.accelerations[k - 1];
    dd1 = h * h * trajectory.accelerations[k];
  }
  const Quintic<Configuration> motion = quintic_between<Configuration>(change, d0, dd0, d1, dd1);
  return {from + motion.change(u), motion.first(u) / h, motion.second(u) / (h * h)};
}

void append_state(const MotionState& state, double time, const Trajectory& columns,
                  Trajectory& result) {
  result.times.push_back(time);
  result.positions.push_back(state.position);
  if (!columns.velocities.empty()) result.velocities.push_back(state.velocity);
  if (!columns.accelerations.empty()) result.accelerations.push_back(state.acceleration);
}

}  // namespace

Trajectory from_time_zero(Trajectory trajectory) {
  const double begin = trajectory.times.front();
  for (double& time : trajectory.times) {
    const double elapsed = time - begin, rounded = std::round(elapsed * 1e9) / 1e9;
    // Differences of whole nanoseconds are whole nanoseconds, but for rounding.
    const double error = std::max(std::abs(time), std::abs(begin)) * 1e-15;
    time = begin != 0 && std::abs(rounded - elapsed) <= error ? rounded : elapsed;
  }
  return trajectory;
}

Trajectory setpoints(const Trajectory& trajectory, double rate) {
  constexpr double slack = 1e-6;  // of a period: rounding of times
  const double begin = trajectory.times.front(), duration = trajectory.times.back() - begin;
  const double periods = std::ceil(duration * rate - slack);
  if (!(periods < max_setpoints)) {
    throw Error("the rate " + number(rate) + " Hz gives " + number(periods) + " setpoints in " +
                number(duration) + " s; at most 10 million are written");
  }
  Trajectory result;
  result.joint_names = trajectory.joint_names;
  std::size_t k = 1;  // the interval ends at sample k
  for (double i = 0; i <= periods; ++i) {
    const double time = i / rate, t = begin + time;
    while (k + 1 < trajectory.size() && trajectory.times[k] <= t) ++k;
    if (k >= trajectory.size() || time > duration + slack / rate) {
      const Configuration& last = trajectory.positions.back();
      append_state({last, 0 * last, 0 * last}, time, trajectory, result);
      continue;
    }
    const double length = trajectory.times[k] - trajectory.times[k - 1];
    const double u = std::min((t - trajectory.times[k - 1]) / length, 1.0);
    append_state(state_between(trajectory, k, u), time, trajectory, result);
  }
  return result;
}

}  // namespace beeline::internal
