#pragma once

#include <span>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/profile.h>

namespace beeline::internal {

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
/// limits times the speed scale. The scaling has a reason, and no points, where there is none.
TimedPath timed_path(const Arm& arm, const JointPath& path, Profile profile, double speed_scale,
                     double tool_speed, BudgetMeter& budget);

/// Throws Error for a tool speed or rate out of range.
void check_options(double tool_speed, double rate);

}  // namespace beeline::internal
