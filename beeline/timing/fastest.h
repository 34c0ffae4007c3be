#pragma once

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline {

/// ds/dt at the path's begin and its end.
struct EndSpeeds {
  double begin = 0, end = 0;
};

/// The quickest motion along the path that keeps the limits of velocity and acceleration and
/// `limits.speed`; jerk is free. By reachability analysis (Pham and Pham, IEEE Transactions on
/// Robotics 34(3), 2018): from the end backward the speeds from which the rest can be driven, then
/// forward the largest of them. Between grid points d2s/dt2 is constant, and there too the limits
/// are kept: exactly for the accelerations of a cubic path, else up to the error of a parabola
/// through both ends and the middle of a step. Linear in the number of grid points.
/// Where nothing moves, the path takes a millisecond in all or more. No law, with the reason, where
/// the speeds at the ends are too high. Throws Error for a path, limits or speeds that make no
/// sense.
TimeScaling fastest(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends = {});

}  // namespace beeline
