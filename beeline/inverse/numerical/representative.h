#pragma once

#include <vector>

#include <beeline/inverse/numerical/bounds.h>

// Configurations that differ by whole turns of joints are one posture of the arm. Here are the
// representatives of a posture within bounds.

namespace beeline::internal {

/// Whether a whole turn of coordinate k leaves the arm as it is: it is revolute, and so are all
/// joints that mimic it, with whole ratios.
bool turns_around(const Arm& arm, int k);

/// Returns the angle plus the whole number of turns that brings it nearest to `reference` within
/// [lower, upper], where `slack` outside counts as within; the value that is least outside where
/// none is within. Radians.
double nearest_turn_within(double angle, double reference, double lower, double upper,
                           double slack = 0);

/// Returns the representative of q's posture that is nearest to `reference` within the bounds.
/// Coordinates that do not turn around stay; one that has no value within the bounds gets the value
/// that is least outside; one that is outside by less than 1e-9 is set on the bound.
Configuration nearest_representative(const Arm& arm, const Configuration& q,
                                     const Configuration& reference, const Bounds& bounds);

/// Returns all representatives within the bounds of each posture, for the coordinates that turn
/// around and have two bounds. Throws Error when there would be more than 100,000.
std::vector<Configuration> every_representative(const Arm& arm,
                                                const std::vector<Configuration>& postures,
                                                const Bounds& bounds);

/// Whether two configurations are the same posture to `tolerance` (radians and metres) in every
/// coordinate.
bool same_posture(const Arm& arm, const Configuration& a, const Configuration& b,
                  double tolerance = 1e-6);

}  // namespace beeline::internal
