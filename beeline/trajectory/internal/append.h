#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Appends a trajectory with the same columns. Its first sample is that at which `trajectory` ends,
/// and is left out, unless `trajectory` has none yet; times are shifted accordingly.
void append(Trajectory& trajectory, const Trajectory& next);

}  // namespace beeline::internal
