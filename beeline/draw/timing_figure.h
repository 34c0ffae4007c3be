#pragma once

#include <optional>
#include <string>

#include <beeline/draw/paper.h>
#include <beeline/draw/path_trace.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

struct TimingFigureOptions {
  std::string title = {};                   ///< default: the arm, and how long it moves
  std::optional<FollowedPath> path = {};    ///< adds the deviation from it
  std::optional<Task> task = std::nullopt;  ///< default: that of the path, or default_task()
};

/// A motion over time: all joints' positions, velocities and accelerations with their limits (see
/// joint_charts.h), the tool's speed, and the inverse condition of the task's Jacobian, 0 at a
/// singularity, lengths in units of the arm's reach. For a motion along a path also the trail with
/// its deviation exaggerated, and the deviation along the way with its bound and tolerance.
/// Throws Error when the trajectory does not fit the arm or has no samples, or `path` does not fit
/// it.
Drawing timing_figure(const Arm& arm, const Trajectory& trajectory,
                      const TimingFigureOptions& options = {});

}  // namespace beeline
