#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/internal/setpoints.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

constexpr double max_setpoints = 1e7;

void append_state(const TrajectoryState& state, double time, const Trajectory& columns,
                  Trajectory& result) {
  result.times.push_back(time);
  result.positions.push_back(state.position);
  if (!columns.velocities.empty()) result.velocities.push_back(state.velocity);
  if (!columns.accelerations.empty()) result.accelerations.push_back(state.acceleration);
}

/// The columns of the last sample, where the joints may move.
TrajectoryState last_state(const Trajectory& trajectory) {
  TrajectoryState state;
  state.position = trajectory.positions.back();
  if (!trajectory.velocities.empty()) state.velocity = trajectory.velocities.back();
  if (!trajectory.accelerations.empty()) state.acceleration = trajectory.accelerations.back();
  return state;
}

}  // namespace

Trajectory from_time_zero(Trajectory trajectory) {
  const double begin = trajectory.times.front();
  for (double& time : trajectory.times) {
    const double elapsed = time - begin, rounded = round_to_nanoseconds(elapsed);
    // Differences of whole nanoseconds are whole nanoseconds up to rounding.
    const double error = std::max(std::abs(time), std::abs(begin)) * 1e-15;
    time = begin != 0 && std::abs(rounded - elapsed) <= error ? rounded : elapsed;
  }
  return trajectory;
}

Trajectory setpoints(const Trajectory& trajectory, double rate) {
  constexpr double slack = 1e-6;  // of a period: rounding of times
  const double begin = trajectory.times.front(), duration = trajectory.times.back() - begin;
  const double periods = duration > 0 ? std::max(1.0, std::ceil(duration * rate - slack)) : 0;
  if (!(periods < max_setpoints)) {
    throw Error::of("rate", "the rate " + number(rate) + " Hz gives " + number(periods) +
                                " setpoints in " + number(duration) +
                                " s; at most 10 million are written");
  }
  Trajectory result;
  result.joint_names = trajectory.joint_names;
  const double end = trajectory.times.back(), near = slack / rate;
  for (double i = 0; i <= periods; ++i) {
    const double time = i / rate, t = begin + time;
    const bool at_end = i == periods && std::abs(t - end) <= near;
    append_state(at_end ? last_state(trajectory) : sample(trajectory, t), time, trajectory, result);
  }
  return result;
}

}  // namespace beeline::internal
