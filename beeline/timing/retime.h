#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

constexpr int default_max_samples = 200'000;

struct RetimeOptions {
  /// Form of the time scaling; default: `jerk`. Every profile keeps known jerk limits; `fastest`
  /// and `trapezoidal` leave jerk free where it is not known.
  std::optional<Profile> profile = std::nullopt;
  Interpolation interpolation = Interpolation::quintic;  ///< of the result
  /// Speed scale k from 1e-6 to 1: velocity limits are multiplied by k, acceleration by k^2, jerk
  /// by k^3.
  double speed_scale = 1;
  double tool_speed = Limits::none;  ///< limit of the tool origin's speed, m/s, 1e-8 or more
  /// Samples per second, at times k / rate from the first to the last of them; 0: every sample of
  /// the path, and as many more as the interpolation needs.
  double rate = 0;
  /// Seconds to which the quickest motion is slowed down, without a rate; default: the shortest.
  std::optional<double> duration = std::nullopt;
  /// With a rate, 2 or more: there is no motion if it makes more; without one, if the path has
  /// more, and more than the default. A sample of the path takes some 70 microseconds and 2.5 kB.
  int max_samples = default_max_samples;
  /// Keep the jumps of continuous joints whose values wrap. The times of the trajectory, which are
  /// otherwise ignored, decide which jumps are wraps.
  bool no_unwrap = false;
  Budget budget = {};
};

/// A trajectory with new times.
struct Retimed {
  Profile profile = Profile::fastest;  ///< of the time scaling
  Reason reason = {};                  ///< why there is no motion, or not the best; otherwise none
  Trajectory trajectory;               ///< empty when there is none
  LimitUsage limits;                   ///< of the trajectory, relative to the arm's own limits
  double tool_speed = 0;               ///< a bound on the tool origin's speed, m/s
  std::size_t sections = 0;  ///< number of sections of the path between stops, those retimed
  std::vector<UnwrappedJoint> unwrapped;  ///< joints of the given trajectory that were unwrapped
  /// How the computation ended. Unless complete, the trajectory has the sections computed so far,
  /// up to a stop, and may take longer than necessary; `limits` and `tool_speed` are not known.
  Ending ending = Ending::complete;

  /// Whether there is a motion, and the best.
  explicit operator bool() const { return !reason; }
};

/// Throws Error unless a trajectory has two different positions, as retime() needs.
void check_moves(const Trajectory& trajectory);

/// Retimes a trajectory from rest to rest: minimises its duration over the time scalings s(t) of
/// the profile, subject to the arm's limits times the speed scale and to the tool's speed (see
/// time_scaling() in profile.h). The geometric path q(s) is the cubic spline through its positions
/// by chord length (joint_spline() in path/joint_path.h). Its times and velocities are ignored,
/// except that stops are kept (a stop is a repeated position or a zero velocity vector) and the
/// path may have a corner there. Continuous joints are unwrapped first (see unwrapped()).
///
/// The result is within the limits at all times, for the motion that its columns mean (see
/// Interpolation): the acceleration of a cubic or quintic one does not jump, so it takes up to 1 %
/// longer than a time scaling that does, and more where known limits of jerk need wider ramps; with
/// a rate about a period more for each section. Without a rate every position remains a sample, to
/// the motion of a nanosecond, unless it follows the one before within 10 microseconds; with a rate
/// only the first and the last of each section do, and each section lasts a whole number of
/// periods.
///
/// Returns no motion, with the reason, when a position or the spline between two leaves the arm's
/// limits, where there are too many samples or the rate makes none within limits, and for a
/// duration that is too short. Throws Error when the trajectory does not fit the arm or has no two
/// different positions, and for options out of range.
Retimed retime(const Arm& arm, const Trajectory& trajectory, const RetimeOptions& options = {});

}  // namespace beeline
