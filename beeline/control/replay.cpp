#include <algorithm>
#include <cmath>

#include <beeline/control/player.h>
#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>

namespace beeline {
namespace {

constexpr std::size_t max_samples = 1'000'000;
constexpr double lead_in_samples = 64;  // at least
constexpr double already_there = 1e-9;

void check(const ReplayOptions& options) {
  for (const double positive : {options.rate, options.speed}) {
    if (positive > 0 && std::isfinite(positive)) continue;
    throw Error("the rate and the speed of a replay must be above zero, not " + number(positive));
  }
  double before = -1;
  for (const auto& [time, speed] : options.speed_at) {
    if (!(time >= 0 && time > before && std::isfinite(time))) {
      throw Error("the times of a replay's speeds must increase from 0 s on; one is " +
                  number(time) + " s" + (before < 0 ? "" : " after " + number(before) + " s"));
    }
    if (!(speed >= 0 && speed <= 1)) {
      throw Error("a replay's speed at a time must be from 0 to 1, not " + number(speed) + " at " +
                  number(time) + " s");
    }
    before = time;
  }
  if (!options.speed_at.empty() && options.speed_at.back().speed == 0) {
    throw Error("a replay that pauses at " + number(before) +
                " s and does not go on would never end; a later speed above zero would do");
  }
}

[[noreturn]] void refuse_length(double duration, double rate) {
  throw Error("replaying " + number(duration) + " s at " + number(rate) +
              " samples a second makes more than " + std::to_string(max_samples) + " samples");
}

/// In steps, which do not keep every recorded sample.
void check_steps(const Trajectory& recording, double rate) {
  constexpr double fewest_steps = 4, up = 1 + 1e-5;  // that number() rounds away
  const double duration = recording.times.back() - recording.times.front();
  if (duration == 0 || rate * duration >= fewest_steps) return;
  throw Error(number(rate) + " samples a second lose the way of a recording of " +
              number(duration) + " s; " + number(up * fewest_steps / duration) +
              " or more would do");
}

/// The largest share of a velocity limit that is used.
struct Fastest {
  double share = 0;
  int coordinate = 0;
  double time = 0;   ///< the recording's
  double speed = 1;  ///< of playing, at that time

  void take(const Arm& arm, const Configuration& velocity, double now, double speed_now) {
    for (int i = 0; i < arm.dof(); ++i) {
      const double limit = arm.limits(i).velocity;
      const double used = std::abs(velocity[i]) / limit;
      if (used > share) *this = {used, i, now, speed_now};
    }
  }
};

/// Of straight lines between the samples.
Fastest fastest_moment(const Arm& arm, const Trajectory& recording, double speed) {
  Fastest fastest;
  const auto& [names, t, q, v, a] = recording;
  for (std::size_t k = 1; k < recording.size(); ++k) {
    const Configuration velocity = (q[k] - q[k - 1]) / (t[k] - t[k - 1]);
    fastest.take(arm, speed * velocity, t[k - 1], speed);
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
  if (!(duration * options.rate + double(recording.size()) < double(max_samples))) {
    refuse_length(duration, options.rate);
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

/// At one speed.
void play(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
          Replay& result) {
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
}

/// Takes straight lines between the samples, at that speed, from one of the recording's times to
/// another: a step may pass many samples.
void take_part(Fastest& fastest, const Arm& arm, const Trajectory& recording, double from,
               double to, double speed) {
  const auto& [names, t, q, v, a] = recording;
  if (t.size() < 2) return;
  const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, from);
  for (auto k = static_cast<std::size_t>(after - t.begin()); k < t.size(); ++k) {
    const double begin = std::max(from, t[k - 1]);
    fastest.take(arm, speed * (q[k] - q[k - 1]) / (t[k] - t[k - 1]), begin, speed);
    if (t[k] >= to) break;
  }
}

/// At speeds that change.
Fastest play_in_steps(const Arm& arm, const Trajectory& recording, const ReplayOptions& options,
                      Replay& result) {
  check_steps(recording, options.rate);
  const Configuration start = options.start.value_or(recording.positions.front());
  const double dt = 1 / options.rate;
  Player player(arm, recording, start,
                {.time_step = dt, .speed = options.speed, .ramp = options.ramp});
  result.trajectory = at_rest(arm, start);
  auto& [names, times, q, v, a] = result.trajectory;
  a.clear();
  Fastest fastest, commanded;
  auto change = options.speed_at.begin();
  while (!player.done()) {
    const double begin = times.back(), hair = 1e-6 * dt;
    while (change != options.speed_at.end() && change->time <= begin + hair) {
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
    take_part(fastest, arm, recording, time, player.recording_time(), speed);
    commanded.take(arm, command.velocity, time, speed);
  }
  return commanded.share > fastest.share ? commanded : fastest;
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  check(options);
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  Trajectory recording = matched_to(arm, recorded);
  const bool steady = options.speed_at.empty();
  if (steady) recording.velocities.clear();  // straight from sample to sample
  if (options.start) check_configuration(arm, *options.start);

  Replay result;
  result.status = MotionStatus::outside_limits;
  result.reason = first_violation(arm, recording);
  if (result.reason.empty() && options.start) {
    const auto violations = limit_violations(arm, *options.start);
    if (!violations.empty()) result.reason = "the start: " + violations.front();
  }
  if (!result.reason.empty()) return result;
  const Fastest fastest = steady ? fastest_moment(arm, recording, options.speed)
                                 : play_in_steps(arm, recording, options, result);
  result.fastest = fastest.share;
  // Cubics between the samples of a motion at its limits swing a little above these.
  const double swing = steady ? 1e-9 : 0.02;
  if (result.fastest > 1 + swing) {
    result.reason = "at " + number(fastest.time) + " s joint " +
                    arm.joint_of(fastest.coordinate).name + " moves at " + number(result.fastest) +
                    " times its velocity limit; a speed below " +
                    number(fastest.speed / fastest.share) + " would keep it";
    result.trajectory = {};
    return result;
  }
  if (steady) play(arm, recording, options, result);
  result.status = MotionStatus::reached;
  return result;
}

}  // namespace beeline
