#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

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
Picture timing_figure(const Arm& arm, const Trajectory& trajectory,
                      const TimingFigureOptions& options = {});

/// Draws the same of a trajectory without its arm: positions, velocities and accelerations. Throws
/// Error where check_trajectory() does, and when there are no samples.
Picture timing_figure(const Trajectory& trajectory, const std::string& title = {});

/// A motion with the name of its curve.
struct NamedMotion {
  std::string name;
  Trajectory trajectory;
};

/// Draws the step responses of controllers: for each motion, over time, the distance from its first
/// sample towards the goal, in joint space, in percent of the distance to the goal: (q − q₀)·(g −
/// q₀) / |g − q₀|². Above 100 the motion overshoots. The time axis ends where all motions have come
/// within half a percent for good; a curve ends where it leaves ±300 %. Throws Error for a motion
/// without samples, a goal of another size, and a goal equal to the start.
Picture step_response_figure(const std::vector<NamedMotion>& motions, const Configuration& goal,
                             const std::string& title);

/// Draws a slice of a reach map: each position that is reached in the colour of its value, with a
/// scale beside it, and the arm.
Figure reach_figure(const ReachSlice& slice);

/// Draws slices of two maps beside each other, with one scale: of slices_of(), for example. Throws
/// Error for slices of different measures or planes.
Figure reach_figure(const std::array<ReachSlice, 2>& slices);

}  // namespace beeline
