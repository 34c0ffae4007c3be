#pragma once

#include <optional>

#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

/// When the places of a path are passed.
enum class Profile {
  fastest,      ///< the quickest for velocities and accelerations; jerk is free
  jerk,         ///< a quick one for velocities, accelerations and jerks
  trapezoidal,  ///< along the whole path constant acceleration, cruise, constant deceleration
  quintic,      ///< along the whole path 10 u^3 - 15 u^4 + 6 u^5; keeps jerks too
  s_curve,      ///< along the whole path constant jerks; keeps jerks too
};
std::string name(Profile profile);

/// Whether limits of jerk are kept; they are free under the fastest and the trapezoidal.
bool keeps_jerk(Profile profile);

/// Throws Error listing the profiles for another name.
Profile profile_named(const std::string& name);

/// `jerk` for an arm that has limits of jerk, else `fastest`.
Profile default_profile(const Arm& arm);

struct RetimeOptions {
  std::optional<Profile> profile = std::nullopt;  ///< default_profile() when none is given
  /// Share of the velocity limits, squared of acceleration, cubed of jerk: from 1e-6 to 1.
  double speed_limit = 1;
  double tool_speed = Limits::none;  ///< of the tool's origin, metres per second; 1e-9 at least
  double rate = 0;          ///< samples a second; 0: every sample of the path, and more between
  double fewest_steps = 4;  ///< that a rate must have in the motion: fewer leave nothing of the way
};

struct Retimed {
  Profile profile = Profile::fastest;
  std::string reason;     ///< why there is no motion; empty when there is
  Trajectory trajectory;  ///< empty when there is none
  /// With a rate, of each sample: how far it is on the way along the straight joint lines from
  /// position to position (chord_length()).
  std::vector<double> ways;
  LimitUsage limits;          ///< of the trajectory, against the arm's own limits
  double tool_speed = 0;      ///< the largest at the samples and between, metres per second
  std::size_t stretches = 0;  ///< between which the motion stands still

  bool found() const { return reason.empty(); }
};

/// Throws Error unless a trajectory has two different positions, as retime() needs.
void check_moves(const Trajectory& trajectory);

/// The way of a trajectory with new times, from rest to rest: the cubic spline through its samples
/// (joint_spline.h, by the lengths of the chords), as quickly as the profile and the limits allow.
/// What velocities and times it had play no part, except that it stands still where it stood still,
/// and there may turn a corner: where a position repeats, or all velocities are zero. Every
/// position stays, but for repeated ones, unless a rate is given, which keeps the first and the
/// last one. No motion, with the reason, when a position or the spline between two is outside the
/// arm's limits. Throws Error when the trajectory does not fit the arm, has no two different
/// positions, an option makes no sense, or the rate has too few steps in the motion.
Retimed retime(const Arm& arm, const Trajectory& trajectory, const RetimeOptions& options = {});

}  // namespace beeline
