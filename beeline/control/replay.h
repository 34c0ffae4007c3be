#pragma once

#include <optional>
#include <vector>

#include <beeline/planning/status.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// From a time of playing on, the speed goes towards another one.
struct SpeedChange {
  double time = 0;   ///< seconds from the begin of playing, the lead-in included
  double speed = 1;  ///< share of the recording's own, from 0, which pauses, to 1
};

struct ReplayOptions {
  double rate = 100;  ///< samples a second of what is played
  double speed = 1;   ///< 0.5 takes twice the recorded time
  /// Where the arm is: it first moves to the recording's begin.
  std::optional<Configuration> start = std::nullopt;
  std::vector<SpeedChange> speed_at = {};  ///< in the order of time; none: `speed` throughout
  double ramp = 0.5;  ///< seconds in which the speed changes by 1; for `speed_at` alone
};

struct Replay {
  MotionStatus status = MotionStatus::reached;
  std::string reason;     ///< one sentence; empty when reached
  Trajectory trajectory;  ///< empty unless reached
  double lead_in = 0;     ///< seconds of the motion from `start` to the recording's first sample
  double fastest = 0;     ///< largest share of a velocity limit that is used; 0: none is known
};

/// Plays a recording on the arm, joints matched by name: at one speed every recorded sample is
/// kept, and what is played is linear between them at `rate`, at full speed from the begin. With
/// `speed_at` it is what a Player commands in steps of 1 / `rate` (player.h): the speed goes up
/// from zero and changes steadily, and the last step ends at the recording's end. Answers
/// `outside_limits`, with the joint and the recording's time, when it leaves the arm's position
/// limits or, at this speed, its velocity limits, by the straight lines between its samples; the
/// cubics that a Player commands may be above them by 2 %, as those through a motion at its limits
/// are. Throws Error when the recording does not fit the
/// arm, an option makes no sense, or the last of `speed_at` is a pause, which would never end.
Replay replay(const Arm& arm, const Trajectory& recording, const ReplayOptions& options = {});

}  // namespace beeline
