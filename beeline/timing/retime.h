#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {

constexpr int default_max_samples = 200'000;

struct RetimeOptions {
  /// Profile of the time scaling; default: `jerk`. Every profile keeps known jerk limits; `fastest`
  /// and `trapezoidal` do not limit an unknown jerk.
  std::optional<Profile> profile = std::nullopt;
  Interpolation interpolation = Interpolation::quintic;  ///< interpolation of the result
  /// Largest distance from a position, the norm of the difference, at which the path leaves the
  /// straight joint motions between positions to pass this one in a blend, without a stop; 0: the
  /// arm stops at each position, as it does where the path turns back, and where a neighbour is
  /// nearer than 2e-3. Of blends below 0.05 it is tried whether stops are quicker. Default: the
  /// path is the spline through the positions.
  std::optional<double> joint_blend = std::nullopt;
  /// Speed scale k from 1e-6 to 1: velocity limits are multiplied by k, acceleration by k^2, jerk
  /// by k^3.
  double speed_scale = 1;
  double tool_speed = Limits::none;  ///< limit of the tool origin's speed, m/s, 1e-8 or more
  /// Samples per second, at times k / rate. 0: every sample of the path, and as many more as the
  /// interpolation needs.
  double rate = 0;
  /// Duration to which the quickest motion is slowed down, s, without a rate; default: the
  /// shortest.
  std::optional<double> duration = std::nullopt;
  /// Max samples, 2 or more. With a rate there is no motion if it needs more samples. Without a
  /// rate there is none if the path has more samples than this and than the default. A sample of
  /// the path takes some 70 microseconds and 2.5 kB.
  int max_samples = default_max_samples;
  /// Whether to keep the jumps of continuous joints whose values wrap. The times of the trajectory,
  /// which are otherwise ignored, decide which jumps are wraps.
  bool no_unwrap = false;
  /// Largest excess of the first position over a position limit, 0 to 0.1 rad or m, from which the
  /// motion recovers: a first section leads straight, from rest to rest, to the nearest
  /// configuration within the limits, where the path then begins. Of a recording with
  /// velocities, further positions outside the limits may follow that are in order on the same
  /// straight line: the recording recovers itself.
  double recover = 0;
  Budget budget = {};
};

/// A trajectory with new times.
struct Retimed {
  Profile profile = Profile::fastest;  ///< profile of the time scaling
  Reason reason = {};        ///< reason why there is no motion or not the best one; otherwise none
  Trajectory trajectory;     ///< the retimed trajectory; empty if there is none
  LimitUsage limits;         ///< fractions of the arm's own limits that the trajectory uses
  double tool_speed = 0;     ///< bound on the tool origin's speed, m/s
  std::size_t sections = 0;  ///< number of retimed sections of the path between stops
  /// With options.joint_blend, the radius of the blend at each position but the first and the last;
  /// 0: a stop. Of repeated positions there is one.
  std::vector<double> blends = {};
  std::vector<UnwrappedJoint> unwrapped;  ///< joints of the given trajectory that were unwrapped
  /// The section that leads back within the position limits, with the option `recover`; of a motion
  /// that starts within them none. The trajectory is within the limits after it.
  std::optional<Recovery> recovery = std::nullopt;
  /// How the computation ended. Unless complete, the trajectory has the sections computed so far,
  /// up to a stop, and may take longer than necessary; `limits` and `tool_speed` are not known.
  Ending ending = Ending::complete;

  /// Whether there is a motion and it is the best one.
  explicit operator bool() const { return !reason; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Throws Error unless a trajectory has two different positions, as retime() needs.
void check_moves(const Trajectory& trajectory);

/// Retimes a trajectory from rest to rest: minimises its duration over the time scalings s(t) of
/// the profile, subject to the arm's limits times the speed scale and to the tool's speed (see
/// time_scaling() in time_scaling.h). The geometric path q(s) is the cubic spline through its
/// positions by chord length (joint_spline() in path/joint_path.h) or, with options.joint_blend,
/// straight joint motions with blends. Its times and velocities are
/// ignored, except that stops are kept (a stop is a repeated position or a zero velocity vector)
/// and the path may have a corner there. Continuous joints are unwrapped first (see unwrapped()).
///
/// The result is within the limits at all times, for the motion that its columns mean (see
/// Interpolation): the acceleration of a cubic or quintic motion does not jump, so it takes up to 1
/// % longer than a time scaling with jumps, and more if known jerk limits need wider ramps. With a
/// rate each section takes about a period more. Without a rate every position that the path passes
/// remains a sample, to the motion of a nanosecond, unless it follows the one before within 10
/// microseconds. With a rate
/// only the first and the last position of each section remain samples, and each section lasts a
/// whole number of periods.
///
/// Returns no motion, with the reason, if a position or the spline between two leaves the arm's
/// limits, if there are too many samples, if the rate gives none within limits, or if the duration
/// is too short. Throws Error if the trajectory does not fit the arm or has no two different
/// positions, and for options out of range.
Retimed retime(const Arm& arm, const Trajectory& trajectory, const RetimeOptions& options = {});

/// Plans the motion from rest to rest through configurations, in order: retime() of a trajectory
/// with these positions, which stops at repeated ones. Joint values are numbers; angles are not
/// unwrapped. Throws Error as retime() does.
Retimed move_through(const Arm& arm, std::span<const Configuration> waypoints,
                     const RetimeOptions& options = {});

}  // namespace beeline
