#pragma once

#include <optional>
#include <string>

#include <beeline/draw/line_trace.h>
#include <beeline/draw/paper.h>
#include <beeline/motion/timing/trajectory.h>

namespace beeline {

struct TimingFigureOptions {
  std::string title = {};                   ///< default: the arm, and how long it moves
  std::optional<FollowedLines> lines = {};  ///< adds the deviation from them
  std::optional<Task> task = std::nullopt;  ///< default: that of the lines, or default_task()
};

/// A motion over time: all joints' positions, velocities and accelerations with their limits (see
/// joint_charts.h), the tool's speed, and the inverse condition of the task's Jacobian, 0 at a
/// singularity, lengths in units of the arm's reach. For a motion along lines also the trail with
/// its deviation exaggerated, and the deviation along the way with its bound and tolerance.
/// Throws Error when the trajectory does not fit the arm or has no samples, or `lines` do not fit
/// it.
Drawing timing_figure(const Arm& arm, const Trajectory& trajectory,
                      const TimingFigureOptions& options = {});

}  // namespace beeline
