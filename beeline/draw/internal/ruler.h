#pragma once

#include <span>
#include <vector>

#include <beeline/draw/internal/axis_scale.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/projection.h>

namespace beeline::internal {

/// The rectangle of a panel in which its drawing is drawn, and the projection that fits it there.
struct Plot {
  Projection projection;
  PaperBox box;
};

/// Returns the step between ticks, metres, for both axes: wide enough for the tick labels at this
/// scale (points per metre) and coordinates up to `largest` metres.
double tick_step(double scale, double largest);

/// Returns the scale of the horizontal (0) or vertical (1) axis of a plot with this rectangle
/// relative to the world's origin on paper, metres.
Scale ruler(const PaperBox& relative, int axis, double scale, double step);

/// Returns whether the view looks along an axis of the world, so that the plot can have rulers.
bool has_rulers(const View& view);

/// Draws a frame with ticks, tick labels, axis names ("x [m]") and a light grid.
void draw_rulers(const Plot& plot, double step, std::vector<PaperMark>& marks);

/// Returns grid lines on the ground plane at multiples of a round step, around the content of the
/// drawing and of all frames.
std::vector<Polyline> floor_grid(const Drawing& drawing, std::span<const Drawing> frames = {});

/// Draws the world's axes and a scale bar at the lower edge of the plot.
void draw_scale_bar(const Plot& plot, std::vector<PaperMark>& marks);
constexpr double scale_bar_height = 44;

}  // namespace beeline::internal
