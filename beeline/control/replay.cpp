#include <algorithm>
#include <cmath>

#include <beeline/control/internal/recording_limits.h>
#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>

namespace beeline {
namespace {

constexpr std::size_t max_samples = 1'000'000;
constexpr double min_lead_in_samples = 64;  // for linear interpolation of a short motion
constexpr double at_start = 1e-9;           // rad or m; no motion is needed from this near

void check(const ReplayOptions& options) {
  for (const double positive : {options.rate, options.speed}) {
    if (positive > 0 && std::isfinite(positive)) continue;
    throw Error("the rate and the speed of a replay must be above zero, not " + number(positive));
  }
  double before = -1;  // no time yet
  for (const auto& [time, speed] : options.speed_at) {
    if (!(time >= 0 && time > before && std::isfinite(time))) {
      throw Error("the times of a replay's speeds must be at least 0 s and increase; one is " +
                  number(time) + " s" + (before < 0 ? "" : " after " + number(before) + " s"));
    }
    if (!(speed >= 0 && speed <= 1)) {
      throw Error("a replay's speed at a time must be from 0 to 1, not " + number(speed) + " at " +
                  number(time) + " s");
    }
    before = time;
  }
  if (!options.speed_at.empty() && options.speed_at.back().speed == 0) {
    throw Error("the replay pauses at " + number(before) +
                " s and would not end; add a later speed above zero");
  }
}

[[noreturn]] void refuse_length(double duration, double rate) {
  throw Error("replaying " + number(duration) + " s at " + number(rate) +
              " samples per second makes more than " + std::to_string(max_samples) + " samples");
}

/// Throws Error for a rate that leaves too few steps to represent the motion. Not every recorded
/// sample is kept.
void check_steps(const Trajectory& recording, double rate) {
  constexpr double min_steps = 4;        // a cubic has four coefficients
  constexpr double round_up = 1 + 1e-5;  // number() rounds to six digits
  const double duration = recording.times.back() - recording.times.front();
  if (duration == 0 || rate * duration >= min_steps) return;
  throw Error(number(rate) + " samples per second leave fewer than 4 samples in a recording of " +
              number(duration) + " s; " + number(round_up * min_steps / duration) +
              " or more are needed");
}

/// The largest fraction of a velocity limit that a motion uses.
struct VelocityUsage {
  double fraction = 0;
  int coordinate = 0;
  double time = 0;   ///< of the recording
  double speed = 1;  ///< of the replay, at that time

  void take(const Arm& arm, const Configuration& velocity, double now, double speed_now) {
    for (int i = 0; i < arm.dof(); ++i) {
      const double limit = arm.limits(i).velocity;
      const double used = std::abs(velocity[i]) / limit;
      if (used > fraction) *this = {used, i, now, speed_now};
    }
  }
};

/// Computes the usage of straight lines between the samples.
VelocityUsage usage_of_lines(const Arm& arm, const Trajectory& recording, double speed) {
  VelocityUsage usage;
  const auto& [names, t, q, v, a] = recording;
  for (std::size_t k = 1; k < recording.size(); ++k) {
    const Configuration velocity = (q[k] - q[k - 1]) / (t[k] - t[k - 1]);
    usage.take(arm, speed * velocity, t[k - 1], speed);
  }
  return usage;
}

/// Returns the motion from rest at `start` to rest at `goal`, straight in joint space.
Trajectory lead_in(const Arm& arm, const Configuration& start, const Configuration& goal,
                   double rate) {
  const PointToPoint motion =
      point_to_point(arm, start, goal, {.synchronise = Synchronise::straight});
  return sampled(arm, motion, std::max(rate, min_lead_in_samples / motion.duration));
}

/// Appends every recorded sample, so that corners are kept, and samples at the rate between them.
void append_resampled(Trajectory& played, const Trajectory& recording,
                      const ReplayOptions& options) {
  const double begin = played.times.empty() ? 0 : played.times.back();
  const double first = recording.times.front();
  const double duration = (recording.times.back() - first) / options.speed;
  if (!(duration * options.rate + double(recording.size()) < double(max_samples))) {
    refuse_length(duration, options.rate);
  }
  const auto append = [&](double t, const Configuration& q) {
    if (!played.times.empty() && !(begin + t > played.times.back())) return;
    played.times.push_back(begin + t);
    played.positions.push_back(q);
  };
  const double equal = 1e-6 / options.rate;  // times that differ by less are the same
  double grid = 0;                           // counts the samples at the rate
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const double t = (recording.times[k] - first) / options.speed;
    for (; grid / options.rate < t - equal; ++grid) {
      append(grid / options.rate, sample(recording, first + grid / options.rate * options.speed));
    }
    if (grid / options.rate < t + equal) ++grid;
    append(t, recording.positions[k]);
  }
}

/// Plays at a constant speed.
void play_at_constant_speed(const Arm& arm, const Trajectory& recording,
                            const ReplayOptions& options, Replay& result) {
  Trajectory& played = result.trajectory;
  played.joint_names = arm.joint_names();
  const Configuration& first = recording.positions.front();
  if (options.start && (first - *options.start).lpNorm<Eigen::Infinity>() > at_start) {
    played = lead_in(arm, *options.start, first, options.rate);
    played.velocities.clear();
    played.accelerations.clear();
    result.lead_in = played.times.back();
  }
  append_resampled(played, recording, options);
}

/// Adds the usage of the straight lines between two times of the recording, at this speed: a step
/// may pass many samples.
void add_usage_of_lines(VelocityUsage& usage, const Arm& arm, const Trajectory& recording,
                        double from, double to, double speed) {
  const auto& [names, t, q, v, a] = recording;
  if (t.size() < 2) return;
  const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, from);
  for (auto k = static_cast<std::size_t>(after - t.begin()); k < t.size(); ++k) {
    const double begin = std::max(from, t[k - 1]);
    usage.take(arm, speed * (q[k] - q[k - 1]) / (t[k] - t[k - 1]), begin, speed);
    if (t[k] >= to) break;
  }
}

/// Plays with a Player, at speeds that change. Returns the usage of the lines between samples or of
/// the commands, whichever is larger.
VelocityUsage play_in_steps(const Arm& arm, const Trajectory& recording,
                            const ReplayOptions& options, Replay& result) {
  check_steps(recording, options.rate);
  const Configuration start = options.start.value_or(recording.positions.front());
  const double dt = 1 / options.rate;
  Player player(arm, recording, start,
                {.time_step = dt, .speed = options.speed, .ramp = options.ramp});
  result.trajectory = at_rest(arm, start);
  auto& [names, times, q, v, a] = result.trajectory;
  a.clear();
  VelocityUsage lines, commands;
  auto change = options.speed_at.begin();
  while (!player.done()) {
    const double begin = times.back(), equal = 1e-6 * dt;
    while (change != options.speed_at.end() && change->time <= begin + equal) {
      player.set_speed((change++)->speed);
    }
    if (times.size() == max_samples) refuse_length(begin, options.rate);
    const bool leading_in = player.leading_in();
    const double time = player.recording_time(), speed_before = player.speed();
    const Command& command = player.step();
    times.push_back(static_cast<double>(times.size()) * dt);
    q.push_back(command.q);
    v.push_back(command.velocity);
    if (leading_in) {
      result.lead_in = times.back();
      continue;
    }
    const double speed = std::max(speed_before, player.speed());
    add_usage_of_lines(lines, arm, recording, time, player.recording_time(), speed);
    commands.take(arm, command.velocity, time, speed);
  }
  return commands.fraction > lines.fraction ? commands : lines;
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  check(options);
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  Trajectory recording = matched_to(arm, recorded);
  const bool steady = options.speed_at.empty();
  if (steady) recording.velocities.clear();  // straight lines between the samples
  if (options.start) check_configuration(arm, *options.start);

  Replay result;
  result.status = MotionStatus::outside_limits;
  result.reason = internal::first_violation(arm, recording);
  if (result.reason.empty() && options.start) {
    const auto violations = limit_violations(arm, *options.start);
    if (!violations.empty()) result.reason = "the start: " + violations.front();
  }
  if (!result.reason.empty()) return result;
  const VelocityUsage usage = steady ? usage_of_lines(arm, recording, options.speed)
                                     : play_in_steps(arm, recording, options, result);
  result.velocity_usage = usage.fraction;
  // Cubics through samples of a motion at its limits exceed the limits a little.
  const double excess = steady ? 1e-9 : 0.02;
  if (result.velocity_usage > 1 + excess) {
    result.reason = "at " + number(usage.time) + " s joint " + arm.joint_of(usage.coordinate).name +
                    " moves at " + number(result.velocity_usage) +
                    " times its velocity limit; a speed below " +
                    number(usage.speed / usage.fraction) + " keeps the limit";
    result.trajectory = {};
    return result;
  }
  if (steady) play_at_constant_speed(arm, recording, options, result);
  result.status = MotionStatus::reached;
  return result;
}

}  // namespace beeline
