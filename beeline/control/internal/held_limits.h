#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// What the replay of a recording holds.
struct HeldLimits {
  std::vector<Limits> limits;  ///< of each coordinate
  /// Whether the velocity, acceleration or jerk at [coordinate][order] is the recording's own.
  std::vector<std::array<bool, 4>> recorded = {};
  bool starts_at_rest = false, ends_at_rest = false;  ///< see end_velocity.h
};

/// Returns what the replay of a recording holds at this speed: for each coordinate the limits of
/// motion_limits(), or what the recording itself uses at this speed where that is more. A speed
/// above 1 does not raise them, and known limits of velocity are raised by the fraction
/// `limit_tolerance` at most. A derivative that the interpolation does not bound has no limit where
/// the recording exceeds it by divided differences, and no assumed limit of jerk.
HeldLimits held_limits(const Arm& arm, const Trajectory& recording, double speed,
                       double limit_tolerance = 0);

/// Where and by how much a trajectory exceeds limits.
struct LimitExcess {
  int order = 0;  ///< of the derivative: 0 position, 1 velocity, 2 acceleration, 3 jerk
  int coordinate = 0;
  std::size_t sample = 0;  ///< the one before it
  double fraction = 0;     ///< of the limit; for a position radians or metres beyond it
  double slowdown = 1;     ///< factor on the duration that keeps a limit of a derivative
  bool recorded = false;   ///< the limit is what the recording itself uses
};

/// Returns the excess that needs the largest slowdown, one of the position before others; none
/// where all limits are kept.
std::optional<LimitExcess> largest_excess(const HeldLimits& held, const Trajectory& trajectory);

/// The excess as a reason: its time, joint and limit.
Reason exceeded_limit(const Arm& arm, const Trajectory& trajectory, const LimitExcess& excess);

}  // namespace beeline::internal
