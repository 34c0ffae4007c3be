#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The time rounded to a whole number of nanoseconds, as trajectory files of ROS hold it.
double round_to_nanoseconds(double t);

/// Appends sample k of a trajectory with the same columns, at time t.
void append_sample(Trajectory& trajectory, const Trajectory& from, std::size_t k, double t);

/// Appends a trajectory with the same columns. Its first sample equals the last sample of
/// `trajectory` and is omitted, unless `trajectory` is empty. Times are shifted accordingly.
void append(Trajectory& trajectory, const Trajectory& next);

/// Returns the samples from `first` to `last`, with their times.
Trajectory samples_between(const Trajectory& trajectory, std::size_t first, std::size_t last);

/// Rounds all times to whole nanoseconds. Sums of whole nanoseconds may have rounding errors.
void round_times(Trajectory& trajectory);

}  // namespace beeline::internal
