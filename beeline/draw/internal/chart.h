#pragma once

#include <string>
#include <vector>

#include <beeline/draw/internal/axis_scale.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/paper.h>

namespace beeline::internal {

/// A polyline through values; a single value is drawn as a dot.
struct Curve {
  std::string name = {};  ///< name in the legend; empty: not listed
  std::vector<double> x = {}, y = {};
  Colour colour = ink;
  double width = 1;
  std::vector<double> dashes = {};
  bool right = false;  ///< whether the curve uses the scale on the right
};

/// A horizontal dashed line, such as a limit. It is not drawn when the curves stay below a sixth of
/// it; the legend then says that it is off the scale.
struct ReferenceLine {
  std::string name = {};
  double y = 0;
  bool right = false;
};

/// A thin vertical line with its name above it.
struct Marker {
  double x = 0;
  std::string name = {};
};

/// Curves over one x axis, as plain data.
struct Chart {
  std::string heading = {};
  std::string x_name = {}, left_name = {}, right_name = {};  ///< quantity or unit of each axis
  std::vector<Curve> curves = {};
  std::vector<ReferenceLine> reference_lines = {};
  std::vector<Marker> markers = {};
  double min_span = 1e-6;  ///< smallest span of a scale; smaller changes are rounding
  bool from_zero = false;  ///< whether the scales include zero
};

/// The layout of a chart on paper.
struct ChartCell {
  const Chart* chart = nullptr;
  Scale x = {}, left = {}, right = {};
  bool has_right = false;
  bool numbers_below = true;  ///< whether to draw the tick labels and the name of the x axis
  PaperBox plot = {};
};

/// Returns the height of the heading and the names of the markers above the plot, points.
double heading_height(const ChartCell& cell);

/// Chooses the scales for all curves and reference lines of the chart. Throws Error when a value
/// cannot be drawn, or a curve has different numbers of x and y.
ChartCell cell_of(const Chart& chart);

/// Draws the chart in `cell.plot`.
void draw(const ChartCell& cell, std::vector<PaperMark>& marks);

/// Returns a subset of the curve's points that looks the same on paper: no omitted point is farther
/// than a tenth of a point from the polyline through the kept ones. If points coincide on paper,
/// only the first, lowest, highest and last are kept. The ends are kept.
std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points);

/// Adds markers at these values of x to all charts, numbered from 1 in the first one.
void add_numbered_markers(std::vector<Chart>& charts, const std::vector<double>& values);

/// Draws the legend of the curves in rows that begin at `corner`. Returns its height, points; draws
/// nothing when `marks` is null.
double draw_legend(const std::vector<Curve>& curves, const PaperPoint& corner, double width,
                   std::vector<PaperMark>* marks);

}  // namespace beeline::internal
