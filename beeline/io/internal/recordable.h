#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Checks that a trajectory can be written to a file: it is valid (check_trajectory()), has joints,
/// at most 10 000, and samples, and its joints have distinct names that check_name() accepts.
/// Throws Error otherwise.
void check_recordable(const Trajectory& trajectory);

}  // namespace beeline::internal
