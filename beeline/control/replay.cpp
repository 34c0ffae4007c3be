#include <cmath>

#include <beeline/certificate/verify.h>
#include <beeline/control/internal/recording_limits.h>
#include <beeline/control/internal/replay_attempt.h>
#include <beeline/control/replay.h>
#include <beeline/error.h>
#include <beeline/planning/internal/printed_motion.h>
#include <beeline/trajectory/internal/sample_rate.h>

namespace beeline {
namespace {

void check(const ReplayOptions& options) {
  if (!(options.speed > 0 && std::isfinite(options.speed))) {
    throw Error("the speed of a replay must be above zero, not " + number(options.speed));
  }
  internal::check_rate(options.rate, "the recorded samples");
  double before = -1;  // no previous time
  for (const auto& [time, speed] : options.speed_at) {
    if (!(time >= 0 && time > before && std::isfinite(time))) {
      throw Error::of("speed_at",
                      "the times of a replay's speeds must be at least 0 s and increase; one is " +
                          number(time) + " s" +
                          (before < 0 ? "" : " after " + number(before) + " s"));
    }
    if (!(speed >= 0 && speed <= 1)) {
      throw Error::of("speed_at", "a replay's speed at a time must be from 0 to 1, not " +
                                      number(speed) + " at " + number(time) + " s");
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
    throw Error::of("speed_at", "the replay pauses at " + number(before) +
                                    " s and would not end; add a later speed above zero");
  }
}

/// Throws Error for a rate that leaves too few steps to represent the motion. Some recorded samples
/// may be omitted.
void check_steps(const Trajectory& recording, double rate) {
  constexpr double min_steps = 4;        // a cubic has four coefficients
  constexpr double round_up = 1 + 1e-5;  // number() rounds to six digits
  const double duration = recording.times.back() - recording.times.front();
  if (duration == 0 || rate * duration >= min_steps) return;
  throw Error::of("rate", number(rate) +
                              " samples per second leave fewer than 4 samples in a recording of " +
                              number(duration) + " s; " + number(round_up * min_steps / duration) +
                              " or more are needed");
}

}  // namespace

Replay replay(const Arm& arm, const Trajectory& recorded, const ReplayOptions& options) {
  check(options);
  check_trajectory(recorded);
  if (recorded.size() == 0) throw Error("the recording has no samples");
  internal::check_limit_tolerance(options.limit_tolerance);
  Unwrapped read =
      options.no_unwrap ? Unwrapped{matched_to(arm, recorded), {}} : unwrapped(arm, recorded);
  const Trajectory& recording = read.trajectory;
  if (options.start) check_configuration(arm, *options.start);
  if (!options.speed_at.empty()) check_steps(recording, internal::replay_rate(options));

  Replay result;
  result.unwrapped = read.joints;
  result.status = MotionStatus::outside_limits;
  result.reason = internal::first_violation(arm, recording);
  if (!result.reason && options.start) {
    const auto violations = limit_violations(arm, *options.start);
    if (!violations.empty()) result.reason = violations.front();
    if (result.reason) result.reason.code = ReasonCode::start_outside_limits;
  }
  if (result.reason) return result;
  constexpr double max_slowdown = 2;  // largest slowdown beyond whole periods
  internal::BudgetMeter budget(options.budget);
  internal::ReplayAttempt attempt =
      internal::attempt_replay(arm, recording, options, max_slowdown, budget);
  result = std::move(attempt.replay);
  result.unwrapped = std::move(read.joints);
  if (result) {
    result.limits = limit_usage(arm, result.trajectory);
  } else if (attempt.curable) {
    internal::add_advice(arm, recording, options, attempt, budget, result.reason);
  }
  return result;
}

std::ostream& operator<<(std::ostream& out, const Replay& replay) {
  internal::print_motion(out, replay);
  if (!replay) return out;
  return out << ", up to " << percent_at_most(replay.limits.velocity.fraction)
             << " of the velocity limits";
}

}  // namespace beeline
