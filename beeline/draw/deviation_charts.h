#pragma once

#include <beeline/draw/chart.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/path_trace.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The deviation from the path against the way along it, measured, and the bound proved for each
/// step as stairs: of position and of orientation, as far as the task asks.
std::vector<Chart> deviation_charts(const PathTrace& trace, const FollowedPath& followed);

/// By what the deviation of position is to be multiplied so that it shows in a picture of the
/// path: 1, 2 or 5 times a power of ten, 1 at least.
double exaggeration(const PathTrace& trace);

/// The path, and the tool's trail with its deviation from it so many times as large; the
/// caption says so.
Figure exaggerated_figure(const Arm& arm, const PathTrace& trace, const FollowedPath& followed,
                          double factor);

}  // namespace beeline
