#pragma once

#include <vector>

#include <beeline/inverse/numerical/bounds.h>

// Configurations that differ by multiples of 2 pi in some joints are the same posture of the arm.
// These functions compute the representatives of a posture within bounds.

namespace beeline::internal {

/// Returns the angle plus the multiple of 2 pi that brings it nearest to `reference` within [lower,
/// upper], extended by `slack` on both sides. If no multiple is within, returns the one that
/// exceeds the interval least. Radians.
double nearest_angle_within(double angle, double reference, double lower, double upper,
                            double slack = 0);

/// Returns the representative of q's posture that is nearest to `reference` within the bounds.
/// Coordinates that are not periodic are unchanged. A coordinate without a value within the bounds
/// gets the value that exceeds them least; one that exceeds a bound by less than 1e-9 is clamped to
/// it.
Configuration nearest_representative(const Arm& arm, const ConfigurationRef& q,
                                     const ConfigurationRef& reference, const Bounds& bounds);

/// The same in place.
void move_to_nearest(const Arm& arm, const ConfigurationRef& reference, const Bounds& bounds,
                     Configuration& q);

/// Returns all representatives of each posture within the bounds, for the periodic coordinates that
/// have two bounds. Throws Error when there would be more than 100,000.
std::vector<Configuration> every_representative(const Arm& arm,
                                                const std::vector<Configuration>& postures,
                                                const Bounds& bounds);

/// Whether two configurations are the same posture to `tolerance` (radians and metres) in every
/// coordinate.
bool same_posture(const Arm& arm, const Configuration& a, const Configuration& b,
                  double tolerance = 1e-6);

}  // namespace beeline::internal
