#include <algorithm>
#include <cmath>

#include <beeline/control/internal/recording_limits.h>
#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline {
namespace {

constexpr std::size_t max_samples = 1'000'000;
constexpr double default_rate = 100;        // of a Player
constexpr double min_lead_in_samples = 64;  // for linear interpolation of a short motion
constexpr double at_start = 1e-9;           // rad or m; no motion is needed from this near

void check(const ReplayOptions& options) {
  if (!(options.speed > 0 && std::isfinite(options.speed))) {
    throw Error("the speed of a replay must be above zero, not " + number(options.speed));
  }
  if (!(options.rate >= 0 && std::isfinite(options.rate))) {
    throw Error("the rate of a replay must be above zero, or 0 for the recorded samples, not " +
                number(options.rate));
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

/// Adds the usage of the motion between sample k and the next, at this speed.
void add_usage(VelocityUsage& usage, const Arm& arm, const Trajectory& recording, std::size_t k,
               double speed) {
  const double h = recording.times[k + 1] - recording.times[k];
  Configuration fastest(arm.dof());
  for (int i = 0; i < arm.dof(); ++i) {
    const internal::Extremes range = internal::extremes(
        internal::time_derivative(internal::interval_polynomial(recording, k, i), 1, h));
    fastest[i] = std::max(-range.smallest, range.largest);
  }
  usage.take(arm, speed * fastest, recording.times[k], speed);
}

VelocityUsage usage_of(const Arm& arm, const Trajectory& recording, double speed) {
  VelocityUsage usage;
  for (std::size_t k = 0; k + 1 < recording.size(); ++k) {
    add_usage(usage, arm, recording, k, speed);
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

/// The recording at a constant speed: its samples, or samples at the rate. Then the recording lasts
/// a whole number of periods, so that its end is one of them.
Trajectory at_speed(const Trajectory& recording, const ReplayOptions& options, double periods) {
  const double first = recording.times.front(), last = recording.times.back();
  Trajectory played{recording.joint_names, {}, {}, {}, {}};
  const auto add = [&](double t, const TrajectoryState& state, double speed) {
    played.times.push_back(t);
    played.positions.push_back(state.position);
    played.velocities.push_back(speed * state.velocity);
    played.accelerations.push_back(speed * speed * state.acceleration);
  };
  if (options.rate > 0 && last > first) {
    const double speed = (last - first) * options.rate / periods;
    for (double k = 0; k <= periods; ++k) {
      const bool ends = k == periods;
      const double t = ends ? last : std::min(last, first + k / options.rate * speed);
      add(k / options.rate, sample(recording, t, ends ? Side::before : Side::after), speed);
    }
  } else {
    for (std::size_t k = 0; k < recording.size(); ++k) {
      const bool ends = k + 1 == recording.size() && k > 0;
      add((recording.times[k] - first) / options.speed,
          sample(recording, recording.times[k], ends ? Side::before : Side::after), options.speed);
      played.positions.back() = recording.positions[k];
    }
  }
  internal::keep_columns(played, recording.interpolation());
  return played;
}

/// Plays at a constant speed; with a rate a little slower where the motion through its samples
/// would be faster than the recording allows.
void play_at_constant_speed(const Arm& arm, const Trajectory& recording,
                            const ReplayOptions& options, Replay& result) {
  const double duration = (recording.times.back() - recording.times.front()) / options.speed;
  if (!(duration * options.rate + double(recording.size()) < double(max_samples))) {
    refuse_length(duration, options.rate);
  }
  double periods = std::max(1.0, std::ceil(duration * options.rate - 1e-6));
  Trajectory played = at_speed(recording, options, periods);
  for (int tries = 0; tries < 100 && options.rate > 0; ++tries) {
    if (usage_of(arm, played, 1).fraction <= 1) break;
    played = at_speed(recording, options, ++periods);
  }
  const Configuration& first = recording.positions.front();
  if (options.start && (first - *options.start).lpNorm<Eigen::Infinity>() > at_start) {
    result.trajectory = lead_in(arm, *options.start, first, options.rate);
    internal::keep_columns(result.trajectory, recording.interpolation());
    result.lead_in = result.trajectory.times.back();
  }
  result.trajectory.joint_names = arm.joint_names();
  internal::append(result.trajectory, played);
}

/// Adds the usage of the motion between two times of the recording, at this speed: a step may pass
/// many samples.
void add_usage_between(VelocityUsage& usage, const Arm& arm, const Trajectory& recording,
                       double from, double to, double speed) {
  const auto& t = recording.times;
  if (t.size() < 2) return;
  const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, from);
  for (auto k = static_cast<std::size_t>(after - t.begin()); k < t.size(); ++k) {
    add_usage(usage, arm, recording, k - 1, speed);
    if (t[k] >= to) break;
  }
}

/// Plays with a Player, at speeds that change. Returns the usage of the recording's motion or of
/// the commands, whichever is larger.
VelocityUsage play_in_steps(const Arm& arm, const Trajectory& recording,
                            const ReplayOptions& options, Replay& result) {
  const double rate = options.rate > 0 ? options.rate : default_rate;
  check_steps(recording, rate);
  const Configuration start = options.start.value_or(recording.positions.front());
  const double dt = 1 / rate;
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
    if (times.size() == max_samples) refuse_length(begin, rate);
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
    add_usage_between(lines, arm, recording, time, player.recording_time(), speed);
    commands.take(arm, command.velocity, time, speed);
  }
  return commands.fraction > lines.fraction ? commands : lines;
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  check(options);
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  const Trajectory recording = matched_to(arm, recorded);
  const bool steady = options.speed_at.empty();
  if (options.start) check_configuration(arm, *options.start);

  Replay result;
  result.status = MotionStatus::outside_limits;
  result.reason = internal::first_violation(arm, recording);
  if (result.reason.empty() && options.start) {
    const auto violations = limit_violations(arm, *options.start);
    if (!violations.empty()) result.reason = "the start: " + violations.front();
  }
  if (!result.reason.empty()) return result;
  const VelocityUsage usage = steady ? usage_of(arm, recording, options.speed)
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
