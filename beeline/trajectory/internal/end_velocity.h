#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

enum class TrajectoryEnd { first, last };

/// The velocity of a coordinate at an end of a trajectory, and the largest magnitude that counts as
/// rest there. Linear joints always move at the ends: they may have the velocity that the joint
/// reaches within two intervals.
struct EndVelocity {
  double velocity = 0, allowed = 0;

  bool at_rest() const { return velocity <= allowed && velocity >= -allowed; }
};

/// The largest velocity that counts as rest at a sample beside an interval of h seconds; see
/// EndVelocity.
double rest_velocity(const Trajectory& trajectory, const Limits& limits, double h);

/// Whether velocities of all coordinates, with these limits, count as rest; see rest_velocity().
bool counts_as_rest(const Trajectory& trajectory, const std::vector<Limits>& limits,
                    const Configuration& velocity, double h);

/// Returns the velocity of a coordinate at an end. `limits` are the limits of the coordinate, as
/// motion_limits() returns them. A trajectory of one sample is at rest.
EndVelocity end_velocity(const Trajectory& trajectory, int coordinate, const Limits& limits,
                         TrajectoryEnd end);

}  // namespace beeline::internal
