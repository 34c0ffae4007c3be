#pragma once

#include <memory>
#include <string>

#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

namespace internal {
class Playback;
}

struct PlayerOptions {
  double time_step = 1e-3;  ///< time step of the control loop, seconds, above 0
  double speed = 1;   ///< initial target speed: from 0 (a pause) to 1 (the recording's own speed)
  double ramp = 0.5;  ///< min time in which the speed changes by 1, seconds, above 0
};

/// The set points of one step of a control loop.
struct Command {
  Configuration q;         ///< configuration, rad or m
  Configuration velocity;  ///< joint velocity at that time, rad/s or m/s
};

/// Tracking error: the difference between measured and commanded positions, radians or metres.
struct TrackingError {
  Configuration largest;  ///< largest absolute error of each coordinate
  Configuration rms;      ///< root mean square of each coordinate's error
  long steps = 0;         ///< number of measurements
};

/// Plays a recording in a control loop. The first part is a point-to-point motion from the arm's
/// configuration to the recording's first sample. The recording follows at a speed that may change
/// while it runs, down to zero, which is a pause. Between samples it plays the motion that the
/// columns mean (see Interpolation).
///
/// The speed changes linearly, within the known acceleration limits. Its rate is at least a
/// twentieth of the ramp's rate; otherwise a recording at its acceleration limits could not pause.
/// No step allocates. One object plays once.
class Player {
 public:
  /// Starts at rest at `start`. Throws Error when the recording does not fit the arm or leaves its
  /// position limits, when `start` is outside them, or for an invalid option.
  Player(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
         const PlayerOptions& options = {});
  Player(const Player& other);
  Player(Player&& other) noexcept;  ///< `other` can then only be assigned to or destroyed
  Player& operator=(Player other) noexcept;
  ~Player();

  /// Sets the target speed, from 0 (a pause) to 1. Throws Error for any other value.
  void set_speed(double speed);

  /// Advances by one time step and returns the set points at its end. Stays at the end of the
  /// recording.
  const Command& step();

  /// Records a measured configuration and compares it with the last command. Throws Error when its
  /// size is wrong.
  void measured(const ConfigurationRef& q);

  bool leading_in() const;  ///< true during the motion to the recording's first sample
  bool done() const;
  double speed() const;           ///< current speed, as a fraction of the recording's own speed
  double recording_time() const;  ///< current time of the recording, seconds
  TrackingError tracking() const;

 private:
  std::unique_ptr<internal::Playback> playback_;
};

}  // namespace beeline
