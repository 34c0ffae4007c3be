#pragma once

#include <vector>

#include <beeline/draw/projection.h>

namespace beeline {

/// The rectangle of a panel in which its scene is drawn, with the projection that fits it there.
struct Plot {
  Projection projection;
  Box box;
};

/// The same step between ticks along both axes: wide enough for the numbers at this scale (points
/// per metre) within coordinates of up to `largest` metres.
double tick_step(double scale, double largest);

/// Room for the numbers and the name of the upright axis, when it runs from `low` to `high` metres.
double ruler_width(double step, double low, double high);
constexpr double ruler_height = 28;  ///< room for those of the other axis, below the plot

/// Whether the view looks along a world axis, so that its paper axes can have rulers.
bool has_rulers(const View& view);

/// A frame with ticks, numbers, names ("x [m]") and a light grid.
void draw_rulers(const Plot& plot, double step, std::vector<Mark>& marks);

/// Lines on the floor at multiples of a round step, around what is seen of the scene.
std::vector<Polyline> floor_grid(const Scene& scene);

/// The world's axes and a length to compare with, in a strip at the plot's lower edge.
void draw_scale_bar(const Plot& plot, std::vector<Mark>& marks);
constexpr double scale_bar_height = 44;

}  // namespace beeline
