#pragma once

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/chart.h>
#include <beeline/draw/internal/path_trace.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Charts the deviation from the path over the arc length: the measured deviation, and the bound
/// proved for each step as a step plot. There is a chart for position and one for orientation, if
/// the task has such rows.
std::vector<Chart> deviation_charts(const PathTrace& trace, const FollowedPath& followed);

/// Returns the factor that makes the position deviation visible in a picture of the path: 1, 2 or 5
/// times a power of ten, at least 1.
double exaggeration(const PathTrace& trace);

/// Draws the path and the tool's trail with its deviation multiplied by `factor`, which the caption
/// states.
Figure exaggerated_figure(const Arm& arm, const PathTrace& trace, const FollowedPath& followed,
                          double factor);

}  // namespace beeline::internal
