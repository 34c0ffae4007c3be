#pragma once

#include <optional>
#include <vector>

#include <beeline/error.h>
#include <beeline/planning/status.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// A change of the target speed during a replay.
struct SpeedChange {
  double time = 0;   ///< seconds since the start of playing, the lead-in included
  double speed = 1;  ///< from 0, a pause, to 1, the recording's own speed
};

struct ReplayOptions {
  /// Samples per second, 0 or more; 0: the recorded samples or, with `speed_at`, 100 per second.
  double rate = 0;
  double speed = 1;  ///< above 0: 1 is the recording's own speed, 0.5 takes twice its time
  /// The arm's configuration: the replay begins with a motion from it to the first sample; default:
  /// it begins at the first sample.
  std::optional<Configuration> start = std::nullopt;
  std::vector<SpeedChange> speed_at = {};  ///< at increasing times; none: `speed` throughout
  double ramp = 0.5;  ///< seconds in which the speed changes by 1, above 0; for `speed_at` only
};

struct Replay {
  MotionStatus status = MotionStatus::reached;
  std::string reason;         ///< one sentence; empty when reached
  Trajectory trajectory;      ///< empty unless reached
  double lead_in = 0;         ///< seconds of the motion from `start` to the first sample
  double velocity_usage = 0;  ///< largest |velocity| / velocity limit; 0: no limit is known

  explicit operator bool() const { return status == MotionStatus::reached; }
};

/// Replays a recording on the arm; joints are matched by name. Without `speed_at` the replay is the
/// motion that the recording's columns mean (see Interpolation), at a constant speed: its samples
/// or, with a rate, samples of that motion at k / rate, the last of which is its end, so that the
/// speed is lower by up to a period. With `speed_at` the replay consists of the commands of a
/// Player in steps of 1 / `rate`: the speed starts at zero and changes linearly, and the last step
/// ends at the recording's end; between them it is cubic.
///
/// The status is `outside_limits`, with the joint and the time of the recording, when the replay
/// leaves the position limits or, at this speed, the velocity limits. The cubics of a Player may
/// exceed these by 2 %, because cubics through samples of a motion at its limits do.
/// Throws Error when the recording does not fit the arm, for an invalid option, and when the last
/// entry of `speed_at` is a pause, which would not end.
Replay replay(const Arm& arm, const Trajectory& recording, const ReplayOptions& options = {});

}  // namespace beeline
