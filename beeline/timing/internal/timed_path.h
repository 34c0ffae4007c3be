#pragma once

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// A path with the scaling along it: a motion. The scaling's points include the path's grid points.
struct TimedPath {
  JointPath path;
  TimeScaling scaling;
};

/// Appends the motion, which begins at the trajectory's end if that has samples: every point of the
/// scaling, and more where `gap` seconds would pass between two.
void append_points(Trajectory& trajectory, const TimedPath& motion, double gap);

/// The motions one after the other at `rate` samples a second, and the end of the last one; `ways`
/// gets the path's parameter at each sample, counted on from motion to motion.
Trajectory at_rate(const std::vector<TimedPath>& motions, double rate, std::vector<double>& ways);

}  // namespace beeline
