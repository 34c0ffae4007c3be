#include <algorithm>
#include <cmath>

#include <beeline/control/internal/held_limits.h>
#include <beeline/control/internal/played_section.h>
#include <beeline/control/internal/recording_limits.h>
#include <beeline/control/internal/speed_schedule.h>
#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline {
namespace {

constexpr double default_rate = 100;                             // with changes of speed
constexpr double lead_in_samples = 64, max_lead_in_rate = 1000;  // without a rate
constexpr double at_start = 1e-9;  // rad or m; no motion is needed from this near

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
  if (!(options.ramp > 0 && std::isfinite(options.ramp))) {
    throw Error("the ramp of a replay must be above zero, not " + number(options.ramp) + " s");
  }
  if (!options.speed_at.empty() && !(options.speed <= 1)) {
    throw Error("a replay's speed before its first change must be from 0 to 1, not " +
                number(options.speed));
  }
  if (!options.speed_at.empty() && options.speed_at.back().speed == 0) {
    throw Error("the replay pauses at " + number(before) +
                " s and would not end; add a later speed above zero");
  }
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

/// The largest fraction of a known velocity limit that a motion uses.
struct VelocityUsage {
  double fraction = 0;
  int coordinate = 0;
  double time = 0;   ///< of the recording
  double speed = 1;  ///< of the replay, at that time
};

/// Adds the usage of the motion between sample k and the next, at this speed.
void add_usage(VelocityUsage& usage, const Arm& arm, const Trajectory& recording, std::size_t k,
               double speed) {
  const double h = recording.times[k + 1] - recording.times[k];
  for (int i = 0; i < arm.dof(); ++i) {
    const internal::Polynomial v =
        internal::time_derivative(internal::interval_polynomial(recording, k, i), 1, h);
    const auto fraction = [&](const internal::Extremes& range) {
      return speed * std::max(-range.smallest, range.largest) / arm.limits(i).velocity;
    };
    if (!(fraction(internal::enclosure(v)) > usage.fraction)) continue;
    const double used = fraction(internal::extremes(v));
    if (used > usage.fraction) usage = {used, i, recording.times[k], speed};
  }
}

VelocityUsage usage_at_constant_speed(const Arm& arm, const Trajectory& recording, double speed) {
  VelocityUsage usage;
  for (std::size_t k = 0; k + 1 < recording.size(); ++k) {
    add_usage(usage, arm, recording, k, speed);
  }
  return usage;
}

/// The usage with changes of speed. A step may pass many samples.
VelocityUsage usage_in_steps(const Arm& arm, const Trajectory& recording,
                             std::span<const internal::Progress> steps) {
  VelocityUsage usage;
  const auto& t = recording.times;
  for (std::size_t j = 1; j < steps.size() && t.size() > 1; ++j) {
    const double speed = std::max(steps[j - 1].speed, steps[j].speed);
    const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, steps[j - 1].s);
    for (auto k = static_cast<std::size_t>(after - t.begin()); k < t.size(); ++k) {
      add_usage(usage, arm, recording, k - 1, speed);
      if (t[k] >= steps[j].s) break;
    }
  }
  return usage;
}

/// Sets status and reason where the recording is too fast for a velocity limit.
bool refuse_velocity(const Arm& arm, const VelocityUsage& usage, Replay& result) {
  constexpr double rounding = 1e-9, down = 1 - 1e-5;  // number() rounds to six digits
  if (!(usage.fraction > 1 + rounding)) return false;
  result.reason = "at " + number(usage.time) + " s joint " + arm.joint_of(usage.coordinate).name +
                  " moves at " + number(usage.fraction) +
                  " times its velocity limit; a speed of at most " +
                  number(down * usage.speed / usage.fraction) + " keeps the limit";
  result.limits.velocity = {usage.fraction, arm.joint_of(usage.coordinate).name, usage.time};
  return true;
}

/// Sets status and reason where a speed above 1 exceeds limits that the recording holds.
bool refuse_speed(const Arm& arm, const Trajectory& recording, const internal::HeldLimits& held,
                  double speed, Replay& result) {
  constexpr double rounding = 1e-9, down = 1 - 1e-5;
  if (!(speed > 1)) return false;
  Trajectory faster = recording;
  for (double& t : faster.times) t /= speed;
  for (Configuration& v : faster.velocities) v *= speed;
  for (Configuration& a : faster.accelerations) a *= speed * speed;
  const auto excess = internal::largest_excess(held, faster);
  if (!excess || !(excess->slowdown > 1 + rounding)) return false;
  result.reason = internal::described(arm, recording, *excess) + " at a speed of " + number(speed) +
                  "; a speed of at most " + number(down * speed / excess->slowdown) + " keeps it";
  return true;
}

/// Plays the motion from rest at the start to rest at the recording's first sample, straight in
/// joint space.
internal::PlayedSection lead_in(const Arm& arm, const Configuration& goal,
                                Interpolation interpolation, const ReplayOptions& options,
                                internal::BudgetMeter& budget) {
  const bool steady = options.speed_at.empty();
  const PointToPoint line =
      point_to_point(arm, *options.start, goal, {.synchronise = Synchronise::straight});
  double rate = options.rate > 0 ? options.rate : default_rate;
  if (steady && options.rate == 0) {
    rate = std::min(lead_in_samples / line.duration, max_lead_in_rate);
  }
  const Trajectory motion = sampled(arm, line, rate, budget.part());
  if (motion.size() == 0) return {.trajectory = {}, .reason = internal::ended_by(budget.ending())};
  internal::PlayedMotion played{arm, motion, interpolation, internal::held_limits(arm, motion, 1)};
  played.budget = &budget;
  return steady ? internal::at_constant_speed(played, 1, rate)
                : internal::with_speed_changes(played, options, rate);
}

/// Plays the lead-in, if there is one, and the recording.
void play(const Arm& arm, const Trajectory& recording, internal::HeldLimits held,
          const ReplayOptions& options, internal::BudgetMeter& budget, Replay& result) {
  const bool steady = options.speed_at.empty();
  const double rate = options.rate > 0 || steady ? options.rate : default_rate;
  const Configuration& goal = recording.positions.front();
  internal::PlayedMotion motion{arm, recording, recording.interpolation(), std::move(held)};
  motion.budget = &budget;
  Trajectory& played = result.trajectory;
  if (options.start && (goal - *options.start).lpNorm<Eigen::Infinity>() > at_start) {
    internal::PlayedSection lead = lead_in(arm, goal, motion.interpolation, options, budget);
    result.reason = lead.reason;
    if (!lead.reason.empty()) return;
    played = std::move(lead.trajectory);
    result.lead_in = played.times.back();
    motion.first = played.size() - 1;
  }
  if (!steady) {
    const std::vector<internal::Progress> asked =
        internal::scheduled_progress(arm, recording, {options, rate, motion.first});
    if (refuse_velocity(arm, usage_in_steps(arm, recording, asked), result)) return;
  }
  const internal::PlayedSection section =
      steady ? internal::at_constant_speed(motion, options.speed, rate)
             : internal::with_speed_changes(motion, options, rate);
  result.reason = section.reason;
  result.slowdown = section.slowdown;
  if (!section.reason.empty()) return;
  internal::append(played, section.trajectory);
  played.joint_names = arm.joint_names();
  for (std::size_t k = 0; rate > 0 && k < played.size(); ++k) {
    played.times[k] = internal::time_at_rate(k, rate);
  }
  if (result.lead_in > 0) {  // a recording that does not start at rest
    const auto excess = internal::largest_excess(motion.held, played);
    if (excess) {
      result.reason = "after the lead-in, " + internal::described(arm, played, *excess) +
                      ": the recording does not start at rest";
    }
  }
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  check(options);
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  const Trajectory recording = matched_to(arm, recorded);
  const bool steady = options.speed_at.empty();
  if (options.start) check_configuration(arm, *options.start);
  if (!steady) check_steps(recording, options.rate > 0 ? options.rate : default_rate);

  Replay result;
  result.status = MotionStatus::outside_limits;
  result.reason = internal::first_violation(arm, recording);
  if (result.reason.empty() && options.start) {
    const auto violations = limit_violations(arm, *options.start);
    if (!violations.empty()) result.reason = "the start: " + violations.front();
  }
  if (!result.reason.empty()) return result;
  if (steady &&
      refuse_velocity(arm, usage_at_constant_speed(arm, recording, options.speed), result)) {
    return result;
  }
  internal::HeldLimits held = internal::held_limits(arm, recording, options.speed);
  if (refuse_speed(arm, recording, held, options.speed, result)) return result;
  internal::BudgetMeter budget(options.budget);
  play(arm, recording, std::move(held), options, budget, result);
  if (!result.reason.empty()) {
    result.trajectory = {};
    if (!budget.complete()) result.status = internal::status_of<MotionStatus>(budget.ending());
    return result;
  }
  result.limits = limit_usage(arm, result.trajectory);
  result.status = MotionStatus::reached;
  return result;
}

}  // namespace beeline
