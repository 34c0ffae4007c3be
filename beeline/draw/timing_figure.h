#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/certificate/path_deviation.h>
#include <beeline/draw/paper.h>
#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The path that a motion follows.
struct FollowedPath {
  ToolPath path;
  std::vector<double> path_parameters;  ///< of the samples that follow the path
  Task task;
  std::optional<Deviation> tolerance = std::nullopt;  ///< drawn as a reference line
  /// The poses that the path was made through, in its order, numbered from 1 as in pictures of the
  /// motion; a pose before the first is the start. Default: the ends of the segments.
  std::vector<Pose> waypoints = {};
};

struct TimingFigureOptions {
  std::string title = {};                   ///< default: the arm's name and the duration
  std::optional<FollowedPath> path = {};    ///< draws the deviation from it too
  std::optional<Task> task = std::nullopt;  ///< default: the path's task, or default_task()
  /// When waypoints 1, 2, ... are passed, seconds; default: those of the path.
  std::vector<double> waypoint_times = {};
};

/// Draws a motion over time: positions, velocities and accelerations of all joints with their
/// limits, the speed of the tool, and the inverse condition number of the task's Jacobian (0 at a
/// singularity; lengths in units of the arm's reach). For a motion along a path, also draws the
/// trail with its deviation exaggerated, and the deviation over the arc length with its proved
/// bound and tolerance. Throws Error when the trajectory does not fit the arm, has no samples, or
/// does not fit `path`.
Drawing timing_figure(const Arm& arm, const Trajectory& trajectory,
                      const TimingFigureOptions& options = {});

}  // namespace beeline
