#pragma once

#include <optional>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/planning/branch.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

/// A change of the target speed during a replay.
struct SpeedChange {
  double time = 0;   ///< time since the start of playing, including the lead-in, seconds
  double speed = 1;  ///< target speed from 0 (a pause) to 1 (the recording's own speed)
};

/// Samples per second of a replay with `speed_at`, unless `rate` is given.
constexpr double default_replay_rate = 100;

struct ReplayOptions {
  /// Samples per second, 0 or at least 0.001. With 0 the samples are the recorded ones or, with
  /// `speed_at`, 100 per second.
  double rate = 0;
  /// Factor on the recording's speed, above 0; 0.5 takes twice its time. Below 1 it slows down the
  /// lead-in too.
  double speed = 1;
  /// Configuration from which a motion leads to the first sample, (n,); default: the replay begins
  /// at the first sample.
  std::optional<Configuration> start = std::nullopt;
  /// Target speeds at increasing times; empty: `speed` throughout.
  std::vector<SpeedChange> speed_at = {};
  /// Time in which the speed changes by 1, seconds, above 0; only for `speed_at`.
  double ramp = 0.5;
  bool no_unwrap = false;  ///< whether to keep the jumps of continuous joints whose values wrap
  /// Fraction, 0 to 0.1, by which a recorded velocity may exceed its limit, for the rounding of
  /// other planners. The replay then keeps the recorded velocity as its limit, as it always does
  /// for accelerations and jerks.
  double limit_tolerance = 0;
  Budget budget = {};
};

/// The replay of a recording on an arm.
struct Replay {
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};     ///< why; none if reached
  Trajectory trajectory;  ///< replayed trajectory; empty unless reached
  double lead_in = 0;     ///< duration of the motion from `start` to the first sample, seconds
  /// Duration of the recording in the replay / requested duration. It is above 1 if a rate needs
  /// whole periods, or if the samples need a lower speed. With `speed_at` all speeds are divided by
  /// it.
  double slowdown = 1;
  LimitUsage limits;  ///< use of the limits by the trajectory, or by a recording that is too fast
                      ///< at this speed
  std::vector<UnwrappedJoint> unwrapped;  ///< joints of the recording that were unwrapped

  /// Returns whether the end was reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Prints the status with its reason, or the duration, the samples and the use of the velocity
/// limits.
std::ostream& operator<<(std::ostream& out, const Replay& replay);

/// Replays a recording on the arm. Joints are matched by name, and continuous joints are unwrapped
/// (see unwrapped()). The replay has the recording's columns, and its motion is the motion that
/// these columns mean (see Interpolation) at the given speed.
///
/// - Without a rate and `speed_at` the replay consists of the recorded samples. At a speed other
///   than 1 their times are whole nanoseconds.
/// - With a rate, samples are at k / rate from the first to the last, including the lead-in. The
///   lead-in and each section of the recording from stop to stop last whole periods.
/// - Stops of the recording remain: each is a sample at rest, with the recorded position. A dwell,
///   in which the joints stay within 1e-5 rad or m, is never shorter than in the recording, not
///   even at a speed above 1.
/// - With `speed_at` the speed changes at the rate of the ramp. It changes less if a joint's
///   acceleration would exceed its limit, but at least at a twentieth of that rate. A recording
///   that starts at rest starts at its first speed, any other recording at zero.
///
/// Polynomials through samples of a motion at its limits may exceed the limits. The replay keeps
/// the limits of position, velocity, acceleration and jerk, known or assumed (motion_limits()), at
/// all times, as far as the recording itself keeps them at this speed. For this it is slowed down,
/// to half the speed at most. A limit that the recording exceeds is exceeded by no more than in the
/// recording; `limits` reports it. Derivatives that the interpolation does not bound are measured
/// by divided differences (LimitFraction::exact), except for assumed limits of jerk; if the
/// recording exceeds one of their limits, the replay does not keep it.
///
/// The status is `outside_limits`, with the joint and the time, in four cases: the recording leaves
/// the position limits; it exceeds a known velocity limit at this speed; a speed above 1 makes it
/// exceed a limit of acceleration or jerk; or the slowdown does not suffice. The reason names a
/// speed, a rate or a ramp with which the replay was tried and is within the limits, or says that
/// none was found. Throws Error when the recording does not fit the arm, for an invalid option, and
/// when the last entry of `speed_at` is a pause, which would not end.
Replay replay(const Arm& arm, const Trajectory& recording, const ReplayOptions& options = {});

}  // namespace beeline
