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
  double time = 0;   ///< since the start of playing, lead-in included, s
  double speed = 1;  ///< from 0, a pause, to 1, the recording's own speed
};

struct ReplayOptions {
  /// Samples per second, 0 or at least 0.001; 0: the recorded samples or, with `speed_at`, 100 per
  /// second.
  double rate = 0;
  double speed = 1;  ///< above 0: 1 is the recording's own speed, 0.5 takes twice its time
  /// The configuration from which a motion leads to the first sample; default: the replay begins at
  /// the first sample.
  std::optional<Configuration> start = std::nullopt;
  /// Target speeds at increasing times; empty: `speed` throughout.
  std::vector<SpeedChange> speed_at = {};
  double ramp = 0.5;  ///< time in which the speed changes by 1, s, above 0; for `speed_at` only
  bool no_unwrap = false;  ///< keep the jumps of continuous joints whose values wrap
  /// Fraction, 0 to 0.1, by which a recorded velocity may exceed its limit, for the rounding of
  /// other planners. It is then held as recorded, as accelerations and jerks always are.
  double limit_tolerance = 0;
  Budget budget = {};
};

/// A recording as it is replayed on an arm.
struct Replay {
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};     ///< one sentence; none when reached
  Trajectory trajectory;  ///< empty unless reached
  double lead_in = 0;     ///< duration of the motion from `start` to the first sample, s
  /// The recording's duration / the requested duration: above 1 where a rate needs whole periods,
  /// or its samples a lower speed. With `speed_at` speeds are divided by it.
  double slowdown = 1;
  LimitUsage limits;  ///< of the trajectory, or of a recording that is too fast at this speed
  std::vector<UnwrappedJoint> unwrapped;  ///< joints of the recording that were unwrapped

  /// Whether the end was reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
};

/// Replays a recording on the arm; joints are matched by name, and continuous ones are unwrapped
/// (see unwrapped()). The replay has the recording's columns, and means the motion that these mean
/// (see Interpolation) at the given speed.
///
/// - Without a rate and `speed_at` it consists of the recorded samples. Times at another speed are
///   whole nanoseconds.
/// - With a rate, samples are at k / rate from the first to the last, the lead-in included: the
///   lead-in and each section of the recording from stop to stop last whole periods.
/// - Stops of the recording remain: each is a sample, with the recorded position and at rest. A
///   dwell, where the joints stay within 1e-5 rad or m, is never shorter than in the recording, not
///   even at a speed above 1.
/// - With `speed_at` the speed changes at the rate of the ramp, less where a joint's acceleration
///   would exceed its limit, but at least at a twentieth of it. A recording that starts at rest
///   starts at its first speed, another one at zero.
///
/// Polynomials through samples of a motion at its limits may exceed them. The replay holds the
/// limits of position, velocity, acceleration and jerk, known or assumed (motion_limits()), at all
/// times, as far as the recording itself holds them at this speed: it is slowed down until the
/// polynomials do, to half the speed at most. A limit that the recording exceeds is exceeded by no
/// more than in the recording; `limits` reports it. Derivatives that the interpolation does not
/// bound count by divided differences (LimitFraction::exact), except for assumed limits of jerk;
/// those that the recording exceeds are not held.
///
/// The status is `outside_limits`, with the joint and the time, when the recording leaves the
/// position limits or exceeds a known velocity limit at this speed, when a speed above 1 makes it
/// exceed a limit of acceleration or jerk, and where the slowdown does not suffice: the reason
/// names a speed, a rate or a ramp with which the replay was tried and is within the limits, or
/// that none was found. Throws Error when the recording does not fit the arm, for an invalid
/// option, and when the last entry of `speed_at` is a pause, which would not end.
Replay replay(const Arm& arm, const Trajectory& recording, const ReplayOptions& options = {});

}  // namespace beeline
