#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The limits that the replay of a recording keeps.
struct HeldLimits {
  std::vector<Limits> limits;  ///< limits of each coordinate
  /// Whether the velocity, acceleration or jerk at [coordinate][order] is the recording's own.
  std::vector<std::array<bool, 4>> recorded = {};
  bool starts_at_rest = false, ends_at_rest = false;  ///< see end_velocity.h
};

/// Returns the limits that the replay of a recording keeps at this speed: for each coordinate the
/// limits of motion_limits(), or the recording's own use at this speed if that is more. A speed
/// above 1 does not raise them, and known limits of velocity are raised by the fraction
/// `limit_tolerance` at most. A derivative that the interpolation does not bound has no limit if
/// the recording exceeds its limit by divided differences. Jerk has no assumed limit.
HeldLimits held_limits(const Arm& arm, const Trajectory& recording, double speed,
                       double limit_tolerance = 0);

/// The place and the amount of an exceeded limit.
struct LimitExcess {
  int order = 0;  ///< order of the derivative: 0 position, 1 velocity, 2 acceleration, 3 jerk
  int coordinate = 0;
  std::size_t sample = 0;  ///< the sample before the excess
  double fraction = 0;     ///< value as a fraction of the limit; for a position the distance beyond
                           ///< it, radians or metres
  double slowdown = 1;     ///< factor on the duration with which a derivative is within its limit
  bool recorded = false;   ///< whether the limit is the recording's own use
};

/// Returns the excess that needs the largest slowdown; a position excess precedes all others.
/// Returns nothing if all limits are kept.
std::optional<LimitExcess> largest_excess(const HeldLimits& held, const Trajectory& trajectory);

/// Returns the excess as a reason with its time, joint and limit.
Reason exceeded_limit(const Arm& arm, const Trajectory& trajectory, const LimitExcess& excess);

}  // namespace beeline::internal
