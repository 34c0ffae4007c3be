#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/verify.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/paper.h>
#include <beeline/error.h>
#include <beeline/reach/surface.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The path that a motion follows.
struct FollowedPath {
  ToolPath path;
  std::vector<double> path_parameters;  ///< path parameter of each sample that follows the path
  Task task;
  std::optional<Deviation> tolerance = std::nullopt;  ///< tolerance, drawn as a reference line
  /// Poses that define the path, in its order, numbered from 1 as in pictures of the motion, (N, 4,
  /// 4). A pose before the first waypoint is the start. Default: the ends of the segments.
  std::vector<Pose> waypoints = {};
};

struct TimingFigureOptions {
  std::string title = {};                 ///< title; default: the arm's name and the duration
  std::optional<FollowedPath> path = {};  ///< path of the motion; adds the deviation from it
  /// Task of the condition number; default: the path's task, or default_task().
  std::optional<Task> task = std::nullopt;
  /// Times at which waypoints 1, 2, ... are passed, seconds; default: the times by the path.
  std::vector<double> waypoint_times = {};
  /// Distance from obstacles over time (clearance_over_time()); adds a chart of it, as proved and
  /// as sampled, with the required clearance. If the clearances differ, it is of the distance
  /// beyond them.
  std::optional<ClearanceOverTime> clearance = std::nullopt;
};

/// Draws a motion over time: positions, velocities and accelerations of all joints with their
/// limits, the speed of the tool, and the inverse condition number of the task's Jacobian (0 at a
/// singularity; lengths in units of the arm's reach). For a motion along a path, also draws the
/// trail with its deviation exaggerated, and the deviation over the arc length with its proved
/// bound and tolerance. Throws Error when the trajectory does not fit the arm, has no samples, or
/// does not fit `path`.
Picture timing_figure(const Arm& arm, const Trajectory& trajectory,
                      const TimingFigureOptions& options = {});

/// Draws a trajectory without its arm: positions, velocities and accelerations. Throws Error where
/// check_trajectory() does, and when there are no samples.
Picture timing_figure(const Trajectory& trajectory, const std::string& title = {});

/// A motion with the name of its curve.
struct NamedMotion {
  std::string name;
  Trajectory trajectory;
};

/// Draws the step responses of controllers. Each motion is drawn over time, as its distance from
/// the first sample towards the goal, in joint space, in percent of the distance to the goal: (q −
/// q₀)·(g − q₀) / |g − q₀|². A value above 100 is an overshoot. The time axis ends when all motions
/// stay within half a percent; a curve ends where it leaves ±300 %. Throws Error for a motion
/// without samples, a goal of another size, and a goal equal to the start.
Picture step_response_figure(const std::vector<NamedMotion>& motions, const Configuration& goal,
                             const std::string& title);

/// Draws a slice of a reach map: each reached position in the colour of its value, with a scale
/// beside it, and the arm.
Figure reach_figure(const ReachSlice& slice);

/// Draws slices of two maps beside each other with one scale, for example the slices of
/// slices_of(). Throws Error for slices of different measures or planes.
Figure reach_figure(const std::array<ReachSlice, 2>& slices);

}  // namespace beeline
