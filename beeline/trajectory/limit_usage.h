#pragma once

#include <string>

#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The largest fraction of one kind of limit that a trajectory uses; above 1 it exceeds the limit.
struct LimitFraction {
  double fraction = 0;  ///< 0 where no joint has such a limit, or the derivative is not known
  std::string joint;    ///< the joint that uses it; empty for a fraction of 0
  double time = 0;      ///< seconds; of a difference between samples, that of the earlier sample
};

struct LimitUsage {
  LimitFraction velocity, acceleration, jerk;
};

/// Returns the fractions of the arm's limits that a trajectory uses: the largest of its velocities
/// and accelerations at the samples, and of the difference quotients of positions, velocities and
/// accelerations between samples. These quotients are the rates of a controller that interpolates
/// the columns linearly. By the mean value theorem a motion within its limits at all times passes
/// at any sampling rate. Differences of the size of rounding are ignored. An unknown velocity limit
/// counts as assumed_velocity_limit; other unknown limits are infinite. Throws Error where
/// matched_to() does.
LimitUsage limit_usage(const Arm& arm, const Trajectory& trajectory);

/// Returns the smallest factor k on the duration with which a motion that uses these fractions of
/// its limits is within them: slowed down by k it uses v / k, a / k^2 and j / k^3. The factor is
/// below 1 if the motion may be faster.
double slowdown(double velocity, double acceleration, double jerk);

/// Slows the trajectory down by k: times are multiplied by it, velocities divided, accelerations
/// divided by its square. A factor of 1 or less changes nothing.
void slow_down(Trajectory& trajectory, double k);

}  // namespace beeline
