#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Minimises the duration of a motion along joint paths, at rest where one ends and the next, which
/// begins there, begins. See retime(): without a rate every grid point of the paths is a sample.
/// `tool_speeds` has the limits of the tool's speed of each path; empty: options.tool_speed.
Retimed retimed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                      const RetimeOptions& options, BudgetMeter& budget,
                      const std::vector<ToolSpeeds>& tool_speeds = {});

/// Does the same. A motion that leaves the position limits between two samples has its reason and
/// its trajectory; one with a section that has no motion has neither that section nor later ones.
Retimed timed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                    const RetimeOptions& options, BudgetMeter& budget,
                    const std::vector<ToolSpeeds>& tool_speeds);

/// Returns the samples after which a joint leaves its position limits before the next one.
std::vector<std::size_t> intervals_outside_limits(const Arm& arm, const Trajectory& trajectory);

/// Returns a refusal: the reason, without trajectory and recovery.
Retimed without_motion(Retimed timed);

/// Sets how the computation of a motion of this many sections ended.
void end_with(const BudgetMeter& budget, std::size_t sections, Retimed& timed);

}  // namespace beeline::internal
