#pragma once

#include <string>
#include <vector>

#include <beeline/draw/internal/axis_scale.h>
#include <beeline/draw/internal/paper_shapes.h>

namespace beeline::internal {

/// Returns the position on paper, between `from` and `to`, of a value of the scale.
double on_paper(const Scale& scale, double value, double from, double to);

/// Returns the width of the tick labels and the name of a vertical axis, points.
double side_width(const Scale& scale);

/// Draws a light grid at the ticks of a horizontal and a vertical axis.
void draw_grid(const PaperBox& plot, const Scale& x, const Scale& y, std::vector<PaperMark>& marks);

/// Draws the frame of a plot.
void draw_frame(const PaperBox& plot, std::vector<PaperMark>& marks);

/// Draws the ticks, tick labels and name of the vertical axis left of the plot, or right of it.
void draw_side(const PaperBox& plot, const Scale& scale, const std::string& name, bool right,
               std::vector<PaperMark>& marks);

/// Height of a horizontal axis's tick labels and name, points.
constexpr double numbers_height = 26;

/// Draws the ticks, tick labels and name of the horizontal axis below the plot.
void draw_below(const PaperBox& plot, const Scale& scale, const std::string& name,
                std::vector<PaperMark>& marks);

}  // namespace beeline::internal
