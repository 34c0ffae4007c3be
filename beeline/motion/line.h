#pragma once

#include <functional>
#include <optional>
#include <span>

#include <beeline/motion/status.h>
#include <beeline/motion/straightness.h>
#include <beeline/motion/timing/trajectory.h>

namespace beeline {

struct LineOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;  ///< most the tool may leave the line between samples, metres
  double orientation_tolerance = 1e-3;  ///< and turn away from it, radians
  double tool_speed = Limits::none;     ///< most speed of the tool's origin, metres per second
  int most_samples = 200'000;
  std::function<void(double)> progress = {};  ///< told the share done, in [0, 1], now and then
};

struct LineMotion {
  MotionStatus status = MotionStatus::not_converged;
  std::string reason;                 ///< one sentence with the place; empty when reached
  Trajectory trajectory;              ///< empty unless reached
  std::vector<std::size_t> arrivals;  ///< the sample at each waypoint
  Straightness straightness;          ///< measured again over the finished trajectory
};

/// Moves the tool from its pose at `start` in straight lines through the waypoints (world_T_tool):
/// positions on the segments, orientations by the shortest turn, at rest at each waypoint.
/// Every sample is solved to rounding from the one before it, within joint limits; steps are halved
/// until the bound on the deviation between samples is within tolerance, so the arm can neither cut
/// a corner nor jump to another branch. Redundant joints keep away from their limits.
/// Throws Error when the start or an option makes no sense, or the start is outside the limits.
LineMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const LineOptions& options = {});

}  // namespace beeline
