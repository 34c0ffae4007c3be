#include <algorithm>
#include <cmath>

#include <beeline/control/internal/played_section.h>
#include <beeline/control/internal/replay_attempt.h>
#include <beeline/control/internal/speed_schedule.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/limit_fraction.h>

namespace beeline::internal {
namespace {

constexpr double lead_in_samples = 64, max_lead_in_rate = 1000;  // without a rate
constexpr double at_start = 1e-9;  // rad or m; a start this near needs no motion

/// The largest use of a known velocity limit at the requested speed.
struct VelocityUse {
  double fraction = 0;
  std::size_t sample = 0;  ///< sample of the recording before the use
  double speed = 1;        ///< speed of the replay at that time
};

VelocityUse use_at_constant_speed(std::span<const Limits> limits, const Trajectory& recording,
                                  double speed) {
  const CoordinateFraction own = limit_fraction(limits, recording, 1);
  return {speed * own.fraction, own.sample, speed};
}

/// Returns the largest use with speed changes. A step may pass many samples.
VelocityUse use_in_steps(std::span<const Limits> limits, const Trajectory& recording,
                         std::span<const ParameterState> steps) {
  VelocityUse use;
  if (recording.size() < 2) return use;
  const auto& t = recording.times;
  const std::vector<double> own = limit_fractions(limits, recording, 1);
  for (std::size_t j = 1; j < steps.size(); ++j) {
    const double speed = std::max(steps[j - 1].speed, steps[j].speed);
    const auto after = std::upper_bound(t.begin() + 1, t.end() - 1, steps[j - 1].s);
    for (auto k = static_cast<std::size_t>(after - t.begin()); k < t.size(); ++k) {
      if (speed * own[k - 1] > use.fraction) use = {speed * own[k - 1], k - 1, speed};
      if (t[k] >= steps[j].s) break;
    }
  }
  return use;
}

/// Sets the reason if the recording is too fast for a known velocity limit.
bool refuse_velocity(const Arm& arm, const Trajectory& recording, std::span<const Limits> limits,
                     const VelocityUse& use, double limit_tolerance, ReplayAttempt& attempt) {
  constexpr double rounding = 1e-9;
  if (!(use.fraction > 1 + std::max(rounding, limit_tolerance))) return false;
  const Trajectory there = samples_between(recording, use.sample, use.sample + 1);
  const std::string& joint = arm.joint_of(limit_fraction(limits, there, 1).coordinate).name;
  const double time = recording.times[use.sample];
  attempt.replay.reason = {
      ReasonCode::recording_too_fast,
      {{ReasonField::time, time}, {ReasonField::joint, joint}, {ReasonField::use, use.fraction}}};
  attempt.replay.limits.velocity = {use.fraction, joint, time};
  attempt.speed = use.speed / use.fraction;
  return true;
}

/// Sets the reason if a speed above 1 exceeds limits that the recording keeps.
bool refuse_speed(const PlayedMotion& motion, double speed, ReplayAttempt& attempt) {
  constexpr double rounding = 1e-6;  // rounding of times to nanoseconds
  if (!(speed > 1)) return false;
  const auto excess = largest_excess(motion.held, recorded_samples(motion, speed, 1));
  if (!excess || !(excess->slowdown > 1 + rounding)) return false;
  // The same sample has another time in the recording.
  attempt.replay.reason = exceeded_limit(motion.arm, motion.recording, *excess);
  attempt.replay.reason.set(ReasonField::speed, speed);
  attempt.speed = speed / excess->slowdown;
  return true;
}

/// Plays the motion from rest at the start to rest at the recording's first sample, straight in
/// joint space.
PlayedSection lead_in(const PlayedMotion& recorded, const ReplayOptions& options) {
  const Arm& arm = recorded.arm;
  const bool steady = options.speed_at.empty();
  const double speed = std::min(options.speed, 1.0);
  const PointToPoint line =
      point_to_point(arm, *options.start, recorded.recording.positions.front(),
                     {.synchronise = Synchronise::straight});
  double rate = options.rate > 0 ? options.rate : default_replay_rate;
  if (steady && options.rate == 0) {
    rate = std::min(lead_in_samples / line.duration, max_lead_in_rate);
  }
  const Trajectory motion = sampled(arm, line, rate, recorded.budget.part());
  if (motion.size() == 0) {
    return {.trajectory = {}, .reason = ended_reason(ReasonCode::ended, recorded.budget.ending())};
  }
  PlayedMotion played{arm, motion, recorded.interpolation, held_limits(arm, motion, 1),
                      recorded.budget};
  played.max_slowdown = recorded.max_slowdown;
  const double played_rate = options.rate > 0 ? rate : rate * speed;
  return steady ? at_constant_speed(played, speed, played_rate)
                : with_speed_changes(played, options, rate);
}

/// Plays the lead-in, if there is one, and the recording.
void play(PlayedMotion& motion, const ReplayOptions& options, std::span<const Limits> known,
          ReplayAttempt& attempt) {
  Replay& result = attempt.replay;
  const bool steady = options.speed_at.empty();
  const double rate = replay_rate(options);
  const Configuration& goal = motion.recording.positions.front();
  Trajectory& played = result.trajectory;
  if (options.start && (goal - *options.start).lpNorm<Eigen::Infinity>() > at_start) {
    PlayedSection lead = lead_in(motion, options);
    result.reason = lead.reason;
    if (lead.reason) return;
    played = std::move(lead.trajectory);
    result.lead_in = played.times.back();
    motion.first = played.size() - 1;
  }
  if (!steady) {
    const std::vector<ParameterState> asked =
        scheduled_progress(motion.arm, motion.recording,
                           {options, rate, motion.first, 1, motion.sections, motion.budget});
    const VelocityUse use = use_in_steps(known, motion.recording, asked);
    if (refuse_velocity(motion.arm, motion.recording, known, use, options.limit_tolerance,
                        attempt)) {
      return;
    }
  }
  const PlayedSection section = steady ? at_constant_speed(motion, options.speed, rate)
                                       : with_speed_changes(motion, options, rate);
  result.reason = section.reason;
  result.slowdown = section.slowdown;
  if (section.reason) return;
  append(played, section.trajectory);
  played.joint_names = motion.arm.joint_names();
  for (std::size_t k = 0; rate > 0 && k < played.size(); ++k) {
    played.times[k] = time_at_rate(k, rate);
  }
  if (!(result.lead_in > 0)) return;
  const auto excess = largest_excess(motion.held, played);  // the recording may not start at rest
  if (!excess) return;
  result.reason = exceeded_limit(motion.arm, played, *excess);
  result.reason.code = ReasonCode::moves_after_lead_in;
}

}  // namespace

double replay_rate(const ReplayOptions& options) {
  return options.rate > 0 || options.speed_at.empty() ? options.rate : default_replay_rate;
}

ReplayAttempt attempt_replay(const Arm& arm, const Trajectory& recording,
                             const ReplayOptions& options, double max_slowdown,
                             BudgetMeter& budget) {
  ReplayAttempt attempt;
  Replay& result = attempt.replay;
  result.status = MotionStatus::outside_limits;
  const std::vector<Limits>& known = arm.limits();
  const bool steady = options.speed_at.empty();
  attempt.curable = true;
  if (steady &&
      refuse_velocity(arm, recording, known, use_at_constant_speed(known, recording, options.speed),
                      options.limit_tolerance, attempt)) {
    return attempt;
  }
  PlayedMotion motion{arm, recording, recording.interpolation(),
                      held_limits(arm, recording, options.speed, options.limit_tolerance), budget};
  motion.max_slowdown = max_slowdown;
  if (steady && refuse_speed(motion, options.speed, attempt)) return attempt;
  play(motion, options, known, attempt);
  if (!result.reason) {
    result.status = MotionStatus::reached;
    return attempt;
  }
  result.trajectory = {};
  if (!budget.complete()) {
    result.status = status_of<MotionStatus>(budget.ending());
    attempt.curable = false;
  }
  return attempt;
}

}  // namespace beeline::internal
