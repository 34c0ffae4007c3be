#pragma once

#include <functional>
#include <optional>
#include <span>

#include <beeline/motion/nearest_line.h>
#include <beeline/motion/status.h>
#include <beeline/motion/straightness.h>
#include <beeline/motion/timing/retime.h>

namespace beeline {

struct LineOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double tolerance = 1e-4;                  ///< most the tool may leave the line, metres
  double orientation_tolerance = 1e-4;      ///< and turn away from it, radians
  std::optional<Law> law = std::nullopt;    ///< of time, on each line; default: default_law()
  double tool_speed = Limits::none;         ///< most speed of the tool's origin, metres per second
  double rate = 0;                          ///< samples a second; 0: as few as the tolerance needs
  int most_samples = 200'000;
  bool suggest = false;                       ///< look for lines near by when these cannot be gone
  std::function<void(double)> progress = {};  ///< told the share done, in [0, 1], now and then
};

struct LineMotion {
  MotionStatus status = MotionStatus::not_converged;
  std::string reason;                 ///< one sentence with the place; empty when reached
  std::vector<NearbyLines> nearby;    ///< unless reached: what would work, if it was asked for
  Trajectory trajectory;              ///< empty unless reached
  std::vector<std::size_t> arrivals;  ///< the sample at each waypoint
  Straightness straightness;          ///< measured again over the finished trajectory
  LimitCheck limits;                  ///< the shares of the limits that it uses, measured too
  double limit_margin = 0;            ///< see Branch
  double dexterity = 0;
};

/// Throws Error for tolerances, speeds, rates or numbers of samples that make no sense.
void check_options(const LineOptions& options);

/// Why a finished motion is not within the tolerances by proof; empty where it is.
std::string not_proved(const Straightness& straightness, const LineOptions& options);

/// Moves the tool from its pose at `start` in straight lines through the waypoints (world_T_tool):
/// positions on the segments, orientations by the shortest turn, at rest at each waypoint.
/// Every sample is solved to rounding, within joint limits, and it is proved that between samples,
/// joints in proportion, the tool stays within tolerance: so the arm can neither cut a corner nor
/// jump to another branch. What joints to spare do is planned for the whole way. It is as quick as
/// the law and the joints' limits allow, unknown velocity limits counting as
/// `velocity_when_unknown`.
/// Throws Error when the start or an option makes no sense, or the start is outside the limits.
LineMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const LineOptions& options = {});

/// The same from the first pose on, with the configuration there that is best for the whole way:
/// see plan_lines(). The first of the arrivals is 0.
LineMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const LineOptions& options = {});

}  // namespace beeline
