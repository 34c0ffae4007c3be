#pragma once

#include <vector>

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Whether a whole turn of coordinate k leaves the arm as it is: revolute, and so are all joints
/// that mimic it, by whole ratios.
bool turns_around(const Arm& arm, int k);

/// The same posture with each coordinate that turns around at the value nearest to `reference`
/// among those within the bounds. Other coordinates stay; a coordinate that has no value within the
/// bounds gets the one that is least outside; one that is outside by rounding (1e-9) is set on the
/// bound, so that a solution at a limit is within it.
Configuration nearest_representative(const Arm& arm, const Configuration& q,
                                     const Configuration& reference, const Bounds& bounds);

/// Each posture by every turn within the bounds of those coordinates that turn around and have
/// bounds. Throws Error when there would be more than 100,000.
std::vector<Configuration> every_representative(const Arm& arm,
                                                const std::vector<Configuration>& postures,
                                                const Bounds& bounds);

bool within(const Bounds& bounds, const Configuration& q);

/// Whether two configurations are the same posture, whole turns aside, to `tolerance` (radians and
/// metres) in every coordinate.
bool same_posture(const Arm& arm, const Configuration& a, const Configuration& b,
                  double tolerance = 1e-6);

}  // namespace beeline::internal
