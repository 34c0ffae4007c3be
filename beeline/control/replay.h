#pragma once

#include <optional>

#include <beeline/motion/status.h>
#include <beeline/motion/timing/trajectory.h>

namespace beeline {

struct ReplayOptions {
  double rate = 100;  ///< samples a second of what is played
  double speed = 1;   ///< 0.5 takes twice the recorded time
  /// Where the arm is: it first moves to the recording's begin.
  std::optional<Configuration> start = std::nullopt;
};

struct Replay {
  MotionStatus status = MotionStatus::reached;
  std::string reason;     ///< one sentence; empty when reached
  Trajectory trajectory;  ///< empty unless reached
  double lead_in = 0;     ///< seconds of the motion from `start` to the recording's first sample
  double fastest = 0;     ///< largest share of a velocity limit that is used; 0: none is known
};

/// Plays a recording on the arm: joints matched by name, every recorded sample kept, and linear
/// between them at `rate`. Answers `outside_limits`, with the joint and the time, when the
/// recording leaves the arm's position limits or, at this speed, its velocity limits. Throws Error
/// when the recording does not fit the arm, or an option makes no sense.
Replay replay(const Arm& arm, const Trajectory& recording, const ReplayOptions& options = {});

}  // namespace beeline
