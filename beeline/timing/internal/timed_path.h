#pragma once

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A path with its time scaling. The points of the scaling include the grid points of the path.
struct TimedPath {
  JointPath path;
  TimeScaling scaling;
};

/// Slows the scaling down by the factor k.
void slow_down(TimeScaling& scaling, double k);

/// Appends the motion to the trajectory, starting at its end if it has samples: every point of the
/// scaling, and further samples so that successive ones are at most `gap` seconds apart.
void append_points(Trajectory& trajectory, const TimedPath& motion, double gap);

/// Samples the motions, one after the other, `rate` times a second and at the end of the last.
/// `arc_lengths` receives the path parameter of each sample, summed from motion to motion.
Trajectory at_rate(const std::vector<TimedPath>& motions, double rate,
                   std::vector<double>& arc_lengths);

}  // namespace beeline::internal
