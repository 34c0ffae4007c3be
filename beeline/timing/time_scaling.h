#pragma once

#include <string>
#include <vector>

#include <beeline/path/joint_path.h>

namespace beeline {

/// What a motion along a path keeps. One number for each coordinate, per second and its powers;
/// infinity: no limit.
struct PathLimits {
  Configuration velocity, acceleration, jerk;
  /// The most that ds/dt may be at each grid point of the path, as for a limit of the tool's
  /// speed; empty: no such limit.
  std::vector<double> speed;
};

/// The arm's limits, an unknown velocity limit counting as `velocity_when_unknown`. `share` (from
/// 1e-6 to 1) slows the motion down: that share of the velocities, its square of the
/// accelerations, its cube of the jerks. Throws Error for another share.
PathLimits path_limits(const Arm& arm, double share = 1);

/// Throws Error unless every limit is above zero and there is one for each of the path's
/// coordinates, and none or one speed for each grid point.
void check_limits(const PathLimits& limits, const JointPath& path);

/// When a path's places are passed: s at the time t.
struct TimeScaling {
  std::string reason;                ///< why there is no law; empty when there is one
  std::vector<double> s;             ///< strictly increasing
  std::vector<double> t;             ///< seconds, strictly increasing from 0
  std::vector<double> speed;         ///< ds/dt at the points
  std::vector<double> acceleration;  ///< d2s/dt2; the mean of both sides where it jumps
  bool smooth = false;  ///< the acceleration is continuous; else constant between points

  bool found() const { return reason.empty(); }
  double duration() const { return t.empty() ? 0 : t.back(); }
};

}  // namespace beeline
