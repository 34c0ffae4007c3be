#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Minimises the duration of a motion along joint paths, at rest where one ends and the next, which
/// begins there, begins. See retime(): without a rate every grid point of the paths is a sample.
Retimed retimed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                      const RetimeOptions& options, BudgetMeter& budget);

}  // namespace beeline::internal
