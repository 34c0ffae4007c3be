#pragma once

#include <optional>

#include <beeline/error.h>
#include <beeline/timing/profile.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

struct RetimeOptions {
  std::optional<Profile> profile = std::nullopt;  ///< default: default_profile()
  /// Speed scale k from 1e-6 to 1: velocity limits are multiplied by k, acceleration by k^2, jerk
  /// by k^3.
  double speed_scale = 1;
  double tool_speed = Limits::none;  ///< limit of the tool origin's speed, m/s, 1e-9 or more
  /// Samples per second, 0 or more; 0: every sample of the path, and more between.
  double rate = 0;
  /// Min number of sampling steps in the motion, 0 or more; with fewer, retime() throws Error.
  double min_steps = 4;
};

struct Retimed {
  Profile profile = Profile::fastest;
  std::string reason;     ///< why there is no motion; empty when there is one
  Trajectory trajectory;  ///< empty when there is none
  /// With a rate: arc length along the joint-space polyline, for each sample (chord_length()).
  std::vector<double> arc_lengths;
  LimitUsage limits;         ///< of the trajectory, relative to the arm's own limits
  double tool_speed = 0;     ///< the largest at the samples and between, m/s
  std::size_t sections = 0;  ///< number of sections of the path between stops

  explicit operator bool() const { return reason.empty(); }
};

/// Throws Error unless a trajectory has two different positions, as retime() needs.
void check_moves(const Trajectory& trajectory);

/// Retimes a trajectory from rest to rest: minimises its duration over the time scalings s(t) of
/// the profile, subject to the arm's limits times the speed scale and to the tool's speed (see
/// time_scaling() in profile.h). The geometric path q(s) is the cubic spline through its positions
/// by chord length (joint_spline() in path/joint_path.h). Its times and velocities are ignored,
/// except that stops are kept (a stop is a repeated position or a zero velocity vector) and the
/// path may have a corner there. Without a rate every position remains a sample; with a rate only
/// the first and the last do. Returns no motion, with the reason, when a position or the spline
/// between two leaves the arm's limits. Throws Error when the trajectory does not fit the arm or
/// has no two different positions, for options out of range, and when the rate has too few steps in
/// the motion.
Retimed retime(const Arm& arm, const Trajectory& trajectory, const RetimeOptions& options = {});

}  // namespace beeline
