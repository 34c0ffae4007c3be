#pragma once

#include <string>

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The largest fraction of one kind of limit that a trajectory uses: above 1 it is broken.
struct LimitFraction {
  double fraction = 0;  ///< 0 where no joint has such a limit, or nothing is known
  std::string joint;    ///< whose; empty for a fraction of 0
  double time = 0;      ///< seconds; of a change between samples, that of the earlier one
};

struct LimitUsage {
  LimitFraction velocity, acceleration, jerk;
};

/// How much of its limits an arm uses on a trajectory: at the samples, by the velocities and
/// accelerations that stand there, and between them, by their differences. That is what a
/// controller does that goes from sample to sample in positions, velocities or accelerations in
/// straight lines; and a motion that keeps its limits at all times passes at whatever rate it is
/// sampled (the mean value theorem). What numbers of their size lose by rounding is forgiven. An
/// unknown velocity limit counts as `velocity_when_unknown`; other unknown limits are none.
/// Throws Error where matched_to() does.
LimitUsage limit_usage(const Trajectory& trajectory, const Arm& arm);

}  // namespace beeline
