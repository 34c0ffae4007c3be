#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// Limits of the tool's speed along a joint path, m/s: limits[i] up to the path parameter ends[i]
/// and from the end before it.
struct ToolSpeeds {
  std::vector<double> ends;  ///< increasing; the last is the path's end or beyond
  std::vector<double> limits;

  /// One limit for the whole path.
  ToolSpeeds(double limit = Limits::none)
      : ends{Limits::none}, limits{limit} {}  // NOLINT: implicit

  /// The lowest between two path parameters, from <= to.
  double lowest(double from, double to) const;
  double lowest() const { return lowest(-Limits::none, Limits::none); }
};

/// A path with its time scaling. The points of the scaling include the grid points of the path.
struct TimedPath {
  JointPath path;
  Profile profile = default_profile;
  PathLimits limits;
  TimeScaling scaling;
};

/// Slows the scaling down by the factor k.
void slow_down(TimeScaling& scaling, double k);

/// Returns the path between two stops, with more grid points, and its time scaling within the arm's
/// limits times the speed scale and those of the tool's speed. The scaling has a reason, and no
/// points, where there is none.
TimedPath timed_path(const Arm& arm, const JointPath& path, Profile profile, double speed_scale,
                     const ToolSpeeds& tool_speed, BudgetMeter& budget);

/// Throws Error for a tool speed or rate out of range.
void check_options(double tool_speed, double rate);

}  // namespace beeline::internal
