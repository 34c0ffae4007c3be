#pragma once

#include <vector>

#include <beeline/control/cartesian.h>

#include "line_report.h"

namespace beeline::command {

/// Moves through the waypoints by feedback, and measures the deviation from the lines.
LineReport line_by_control(const Arm& arm, const Configuration& start,
                           const std::vector<Pose>& waypoints, const CartesianOptions& options);

}  // namespace beeline::command
