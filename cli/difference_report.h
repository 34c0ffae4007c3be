#pragma once

#include <beeline/trajectory/difference.h>

#include "output.h"

/// A table: by how much each joint and the tool differ between two recordings, and when.
void print_difference(const beeline::Arm& arm, const beeline::TrajectoryDifference& apart,
                      const UnitArgument& unit);

/// The same as data: keys joints, position, position_time, orientation, orientation_time, overlap,
/// longer.
OrderedJson json_difference(const beeline::Arm& arm, const beeline::TrajectoryDifference& apart,
                            const UnitArgument& unit);
