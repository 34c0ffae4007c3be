#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Returns the trajectory with its first sample at time 0.
Trajectory from_time_zero(Trajectory trajectory);

/// Returns the samples at times k / rate of the motion that the columns mean (linear, cubic or
/// quintic between two samples), with the same columns. The first is at time 0. The last is at rest
/// at the trajectory's last position unless the duration is a whole number of periods; it is then
/// less than one period later. `rate` is above 0. Throws Error if it gives more than ten million
/// samples.
Trajectory setpoints(const Trajectory& trajectory, double rate);

}  // namespace beeline::internal
