#include <algorithm>
#include <cmath>

#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/motion/timing/point_to_point.h>

namespace beeline {
namespace {

constexpr std::size_t most_samples = 1'000'000;
constexpr double lead_in_samples = 64;  // at least
constexpr double already_there = 1e-9;

/// The first sample outside the position limits, as a reason; empty when there is none.
std::string position_violation(const Arm& arm, const Trajectory& recording) {
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const auto outside = limit_violations(arm, recording.positions[k]);
    if (!outside.empty()) return "at " + number(recording.times[k]) + " s " + outside.front();
  }
  return {};
}

/// How fast the recording is against the velocity limits, at its own speed.
struct Fastest {
  double share = 0;  ///< of the limit
  int coordinate = 0;
  double time = 0;
};

Fastest fastest_moment(const Arm& arm, const Trajectory& recording) {
  Fastest fastest;
  for (std::size_t k = 1; k < recording.size(); ++k) {
    const double dt = recording.times[k] - recording.times[k - 1];
    const Configuration step = recording.positions[k] - recording.positions[k - 1];
    for (int i = 0; i < arm.dof(); ++i) {
      const double limit = arm.limits()[static_cast<std::size_t>(i)].velocity;
      const double share = std::abs(step[i]) / dt / limit;
      if (share > fastest.share) fastest = {share, i, recording.times[k - 1]};
    }
  }
  return fastest;
}

/// From rest at `start` to rest at `goal`, in a straight line in joint space.
Trajectory lead_in(const Arm& arm, const Configuration& start, const Configuration& goal,
                   double rate) {
  const PointToPoint motion =
      point_to_point(arm, start, goal, {.synchronise = Synchronise::straight});
  return sampled(arm, motion, std::max(rate, lead_in_samples / motion.duration));
}

/// The recorded samples themselves, so that no corner is cut, and between them more at the rate.
void append_resampled(Trajectory& played, const Trajectory& recording,
                      const ReplayOptions& options) {
  const double begin = played.times.empty() ? 0 : played.times.back();
  const double first = recording.times.front();
  const double duration = (recording.times.back() - first) / options.speed;
  if (!(duration * options.rate + double(recording.size()) < double(most_samples))) {
    throw Error("replaying " + number(duration) + " s at " + number(options.rate) +
                " samples a second makes more than " + std::to_string(most_samples) + " samples");
  }
  const auto append = [&](double t, const Configuration& q) {
    if (!played.times.empty() && !(begin + t > played.times.back())) return;
    played.times.push_back(begin + t);
    played.positions.push_back(q);
  };
  const double hair = 1e-6 / options.rate;  // a grid time this near to a recorded one is the same
  double grid = 0;                          // counts the times of the rate
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const double t = (recording.times[k] - first) / options.speed;
    for (; grid / options.rate < t - hair; ++grid) {
      append(grid / options.rate, sample(recording, first + grid / options.rate * options.speed));
    }
    if (grid / options.rate < t + hair) ++grid;
    append(t, recording.positions[k]);
  }
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  for (const double positive : {options.rate, options.speed}) {
    if (positive > 0 && std::isfinite(positive)) continue;
    throw Error("the rate and the speed of a replay must be above zero, not " + number(positive));
  }
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  const Trajectory recording = matched_to(arm, recorded);
  if (options.start) check_configuration(arm, *options.start);

  Replay result;
  const std::string violation = position_violation(arm, recording);
  const Fastest fastest = fastest_moment(arm, recording);
  result.fastest = fastest.share * options.speed;
  result.status = MotionStatus::outside_limits;
  if (!violation.empty()) {
    result.reason = violation;
    return result;
  }
  if (options.start && !limit_violations(arm, *options.start).empty()) {
    result.reason = "the start: " + limit_violations(arm, *options.start).front();
    return result;
  }
  if (result.fastest > 1 + 1e-9) {
    result.reason = "at " + number(fastest.time) + " s joint " +
                    arm.joint_of(fastest.coordinate).name + " moves at " + number(result.fastest) +
                    " times its velocity limit; a speed below " + number(1 / fastest.share) +
                    " would keep it";
    return result;
  }
  Trajectory& played = result.trajectory;
  played.joint_names = arm.joint_names();
  const Configuration& first = recording.positions.front();
  if (options.start && (first - *options.start).lpNorm<Eigen::Infinity>() > already_there) {
    played = lead_in(arm, *options.start, first, options.rate);
    played.velocities.clear();
    played.accelerations.clear();
    result.lead_in = played.times.back();
  }
  append_resampled(played, recording, options);
  result.status = MotionStatus::reached;
  return result;
}

}  // namespace beeline
