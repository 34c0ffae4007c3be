#pragma once

#include <beeline/draw/chart.h>
#include <beeline/draw/figure.h>
#include <beeline/draw/line_trace.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The deviation from the lines against the way along them, measured, and the bound proved for each
/// step as stairs: of position and of orientation, as far as the task asks.
std::vector<Chart> deviation_charts(const LineTrace& trace, const FollowedLines& lines);

/// By what the deviation of position is to be multiplied so that it shows in a picture of the
/// lines: 1, 2 or 5 times a power of ten, 1 at least.
double exaggeration(const LineTrace& trace);

/// The lines, and the tool's trail with its deviation from them so many times as large; the
/// caption says so.
Figure exaggerated_figure(const Arm& arm, const LineTrace& trace, const FollowedLines& lines,
                          double factor);

}  // namespace beeline
