#pragma once

#include <vector>

#include <beeline/draw/internal/paper_shapes.h>

namespace beeline::internal {

/// Returns the outline of the points within `radius` of the convex hull of `points`: a polygon,
/// whose arcs are divided into steps of at most 10 degrees. Empty without points.
std::vector<PaperPoint> outline_of(std::vector<PaperPoint> points, double radius);

/// Returns the part of a convex polygon inside a rectangle (Sutherland and Hodgman, "Reentrant
/// polygon clipping", 1974).
std::vector<PaperPoint> clipped(std::vector<PaperPoint> polygon, const PaperBox& box);

/// Returns the parts of the polygon's edges inside a rectangle.
PaperPath clipped_edges(const std::vector<PaperPoint>& polygon, const PaperBox& box);

}  // namespace beeline::internal
