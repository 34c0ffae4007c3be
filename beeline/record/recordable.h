#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Throws Error for a trajectory that no file may hold: what check_trajectory refuses, no samples,
/// no joints, a joint's name that check_name refuses or that stands there twice.
void check_recordable(const Trajectory& trajectory);

}  // namespace beeline
