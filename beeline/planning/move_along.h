#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <span>

#include <beeline/certificate/path_deviation.h>
#include <beeline/planning/nearby_path.h>
#include <beeline/planning/status.h>
#include <beeline/timing/retime.h>

namespace beeline {

struct PathMotionOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;                  ///< most the tool may leave its path, metres
  double orientation_tolerance = 1e-4;      ///< and turn away from it, radians
  std::optional<Profile> profile =
      std::nullopt;                  ///< of time, from stop to stop; default: default_profile()
  double tool_speed = Limits::none;  ///< most speed of the tool's origin, metres per second
  double rate = 0;                   ///< samples a second; 0: as few as the tolerance needs
  int max_samples = 200'000;
  bool suggest = false;                       ///< look for a path near by when this cannot be gone
  std::function<void(double)> progress = {};  ///< told the share done, in [0, 1], now and then
};

struct PathMotion {
  MotionStatus status = MotionStatus::not_converged;
  std::string reason;                   ///< one sentence with the place; empty when reached
  std::vector<NearbyPath> nearby;       ///< unless reached: what would work, if it was asked for
  Trajectory trajectory;                ///< empty unless reached
  ToolPath path;                        ///< that it follows
  std::vector<double> path_parameters;  ///< on it, of each sample
  std::vector<std::size_t> arrivals;    ///< the sample at, or first behind, each waypoint
  PathDeviation deviation;              ///< measured again over the finished trajectory
  LimitUsage limits;                    ///< the shares of the limits that it uses, measured too
  double limit_margin = 0;              ///< see Branch
  double dexterity = 0;
};
/// Prints the status with the reason, or with the duration and the proved deviation.
std::ostream& operator<<(std::ostream& out, const PathMotion& motion);

/// Moves the tool along a path, at rest where the route stops.
/// Every sample is solved to rounding, within joint limits, and it is proved that between samples,
/// joints in proportion, the tool stays within tolerance (path_deviation()): so the arm can neither
/// cut a corner nor jump to another branch. Begins at `start`, which must have the tool at the
/// path's begin, or with the configuration there that is best for the whole way; what joints to
/// spare do is planned for the whole way (plan_path()). It is as quick as the profile and the
/// joints' limits allow, unknown velocity limits counting as `velocity_when_unknown`. A waypoint is
/// the end of a segment. Throws Error when the start or an option makes no sense, the start is
/// outside the limits, and what check_task() refuses.
PathMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const PathMotionOptions& options = {});

/// The same from the tool's pose at `start` in straight lines through the waypoints (world_T_tool):
/// positions on the segments, orientations by the shortest turn, at rest at each waypoint.
PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options = {});

/// The same from the first pose on. The first of the arrivals is 0.
PathMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const PathMotionOptions& options = {});

}  // namespace beeline
