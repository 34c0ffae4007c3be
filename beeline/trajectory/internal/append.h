#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The time rounded to a whole number of nanoseconds, as trajectory files of ROS hold it.
double in_nanoseconds(double t);

/// Appends a trajectory with the same columns. Its first sample is that at which `trajectory` ends,
/// and is left out, unless `trajectory` has none yet; times are shifted accordingly, and rounded to
/// whole nanoseconds.
void append(Trajectory& trajectory, const Trajectory& next);

}  // namespace beeline::internal
