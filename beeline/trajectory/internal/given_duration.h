#pragma once

#include <optional>
#include <string>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Throws Error unless a duration, if it is given, is finite and above 0.
void check_duration(const std::optional<double>& duration);

/// Throws Error for a duration together with a rate, at which sections last whole periods.
void refuse_duration_with_rate(const std::optional<double>& duration, double rate);

/// Returns the reason why a duration cannot be kept: the shortest duration within the limits is
/// longer.
Reason too_short(double duration, double shortest);

/// Slows a trajectory that starts at time 0 down to a duration, its times rounded to nanoseconds.
/// If the duration is shorter than the trajectory's, returns the reason and does not change the
/// trajectory.
Reason set_duration(Trajectory& trajectory, double duration);

}  // namespace beeline::internal
