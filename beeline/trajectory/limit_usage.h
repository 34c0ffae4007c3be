#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The largest fraction of one kind of limit that a trajectory uses; above 1 it exceeds the limit.
struct LimitFraction {
  double fraction = 0;  ///< largest fraction of the limit
  std::string joint;    ///< the joint that uses it; empty for a fraction of 0
  double time = 0;      ///< time of the sample before it, or at which it jumps, s
  /// Whether it is exact for the motion that the columns mean. Otherwise the interpolation does not
  /// bound this derivative, which jumps at the samples; the fraction is then the need of the
  /// smoothest motion through the samples, computed by divided differences.
  bool exact = true;
  bool assumed = false;  ///< whether the limit is unknown and assumed: see motion_limits()
};

/// The fractions of the arm's limits that a trajectory uses.
struct LimitUsage {
  /// Use of the position limits: the largest distance of a joint from the middle of its range, as a
  /// fraction of half the range. Its `joint` is empty if no joint has a lower and an upper limit.
  LimitFraction position;
  LimitFraction velocity;      ///< use of the velocity limits
  LimitFraction acceleration;  ///< use of the acceleration limits
  LimitFraction jerk;          ///< use of the jerk limits
  /// How the computation ended; unless complete, these are the largest so far.
  Ending ending = Ending::complete;
};

/// Returns the fractions of the arm's limits that a trajectory uses: the extremes of the
/// polynomials between its samples (see Interpolation), by the zeros of their derivatives. Exact
/// for the position and velocity of any trajectory, the acceleration of cubics and quintics, and
/// the jerk of quintics. Unknown limits are assumed: see motion_limits(). Throws Error as
/// matched_to() does.
LimitUsage limit_usage(const Arm& arm, const Trajectory& trajectory, const Budget& budget = {});

/// The beginning of a motion that starts outside the position limits and leads back within them.
/// Each joint that starts outside moves towards its limit: its excess over the limit never rises,
/// and the joint does not leave its limits again.
struct Recovery {
  double excess = 0;       ///< largest excess over a position limit at the start, rad or m
  std::string joint = {};  ///< the joint with this excess
  std::size_t sample =
      0;            ///< index of the first sample at which all joints are within their limits
  double time = 0;  ///< time of that sample, s
};

/// Returns the recovery of a trajectory, by its samples; nothing if it starts within the position
/// limits, to position_slack. If the motion does not come back, `sample` is its last one. verify()
/// proves that the excess falls between the samples too. Throws Error as matched_to() does.
std::optional<Recovery> recovery_of(const Arm& arm, const Trajectory& trajectory);

/// Returns the index of the sample at which the path of a motion begins: the last one of its
/// recovery, without one the first.
std::size_t begin_of_path(const std::optional<Recovery>& recovery);

/// Returns the recovery of a trajectory whose path begins after it: recovery_of(), if its excess is
/// at most `recover`, the option of verify(), to rounding. Throws Error as verify() does for
/// `recover`.
std::optional<Recovery> accepted_recovery(const Arm& arm, const Trajectory& trajectory,
                                          double recover);

/// The largest excess from which a motion may recover, rad or m.
constexpr double max_recover = 0.1;

/// Returns a slight excess over the position limits: 1e-4 of the smallest range of a joint, rad or
/// m, at most max_recover; 0 if no joint has two limits.
double slight_excess(const Arm& arm);

/// Returns the configuration within the position limits that is nearest to q, rad or m. Throws
/// Error when q does not fit the arm.
Configuration nearest_within_limits(const Arm& arm, const ConfigurationRef& q);

/// Returns the smallest factor k on the duration with which a motion that uses these fractions of
/// its limits is within them: slowed down by k it uses v / k, a / k^2 and j / k^3. The factor is
/// below 1 if the motion may be faster.
double slowdown_factor(double velocity, double acceleration, double jerk);

/// Slows the trajectory down by k: times are multiplied by it, velocities divided, accelerations
/// divided by its square. A factor of 1 or less changes nothing.
void slow_down(Trajectory& trajectory, double k);

}  // namespace beeline
