#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/path/joint_path.h>

namespace beeline {

/// The limits of a motion along a path. One number for each coordinate, radians or metres per
/// second and its powers; infinity: no limit. Finite limits are from 1e-100 on.
struct PathLimits {
  Configuration velocity, acceleration, jerk;
  /// The largest ds/dt at each grid point of the path, as for a limit of the tool's speed; empty:
  /// no such limit.
  std::vector<double> speed;
  /// The fraction of the limits of acceleration and jerk that may be used at each grid point, above
  /// 0 to 1; empty: all of them everywhere.
  std::vector<double> fraction = {};
};

/// Returns the arm's limits, unknown ones replaced by assumed ones: see motion_limits(). The
/// speed scale k, from 1e-6 to 1, slows the motion down: velocity limits are multiplied by k,
/// acceleration by k^2, jerk by k^3. Throws Error for another scale.
PathLimits path_limits(const Arm& arm, double speed_scale = 1);

/// Throws Error unless there is one limit of each kind, 1e-100 or more, for each coordinate of the
/// path, and no speed or fraction or one for each grid point.
void check_limits(const PathLimits& limits, const JointPath& path);

/// A time scaling s(t) of a path: the path parameter as a function of time.
struct TimeScaling {
  Reason reason = {};                ///< why there is no time scaling
  std::vector<double> s;             ///< path parameter, strictly increasing
  std::vector<double> t;             ///< seconds, strictly increasing from 0
  std::vector<double> speed;         ///< ds/dt at the points
  std::vector<double> acceleration;  ///< d2s/dt2; the mean of both sides where it jumps
  /// Whether d2s/dt2 is continuous: between points s(t) then is the quintic Hermite polynomial;
  /// else d2s/dt2 is constant there.
  bool smooth = false;

  explicit operator bool() const { return !reason; }
  double duration() const { return t.empty() ? 0 : t.back(); }
};

}  // namespace beeline
