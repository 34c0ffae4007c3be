#pragma once

#include <string>

#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

struct PlayerOptions {
  double time_step = 1e-3;  ///< seconds between two steps
  double speed = 1;         ///< share of the recording's own speed, at first
  double ramp = 0.5;        ///< seconds in which the speed changes by 1, at the quickest
};

/// What is commanded in one step of a loop.
struct Command {
  Configuration q;
  Configuration velocity;  ///< what the joints do at that moment, per second
};

/// How far an arm was from where it was told to be.
struct TrackingError {
  Configuration largest;  ///< of each coordinate, radians or metres
  Configuration rms;
  long steps = 0;  ///< that were told
};

/// When and how a recording first leaves the arm's position limits: at a sample, or between two by
/// the velocities that it has there. Empty when it never does. Throws Error when it does not fit.
std::string first_violation(const Arm& arm, const Trajectory& recording);

/// Plays a recording step by step, in a control loop: first from where the arm is to the
/// recording's begin (point_to_point.h), then at a speed that may change while it runs, down to
/// zero, which is a pause. The speed goes up and down steadily, and not faster than accelerations
/// allow as far as these are known; but at a twentieth of the ramp's rate at least, so that a
/// recording which uses all of its accelerations can pause too. Between samples the way is the
/// cubic that their velocities make, or straight where there are none. No step allocates. One
/// object for each playing.
class Player {
 public:
  /// Begins at rest at `start`. Throws Error when the recording does not fit the arm or leaves its
  /// position limits (first_violation()), `start` is outside them, or an option makes no sense.
  Player(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
         const PlayerOptions& options = {});

  /// From now on the speed goes towards this, from 0, which pauses, to 1. Throws Error for another.
  void set_speed(double speed);

  /// One step of time: where the arm should be at its end. Stays at the recording's end.
  const Command& step();

  /// Where the arm was found to be, to be compared with the last command. Throws Error when it does
  /// not fit.
  void measured(const ConfigurationRef& q);

  bool leading_in() const { return lead_time_ < lead_.duration; }  ///< on the way to the begin
  bool done() const;
  double speed() const { return speed_; }          ///< now
  double recording_time() const { return time_; }  ///< of the recording, seconds
  TrackingError tracking() const;

 private:
  double largest_change() const;
  void read(double time);

  Arm arm_;
  PlayerOptions options_;
  Trajectory recording_;
  PointToPoint lead_;
  double lead_time_ = 0, time_ = 0, speed_ = 0, wanted_ = 1;
  std::size_t segment_ = 0;  ///< the sample before `time_`
  Command command_;
  Configuration slope_, acceleration_;  ///< by the recording's time
  Configuration largest_, squares_;
  long steps_ = 0;
};

}  // namespace beeline
