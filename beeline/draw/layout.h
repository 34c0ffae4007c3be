#pragma once

#include <string>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/draw/symbols.h>

namespace beeline {

constexpr double caption_size = 9, caption_leading = 12;  ///< points
constexpr double column_gap = 20, panel_gap = 14;         ///< between columns, and within one

/// A panel on its way to paper.
struct Cell {
  const Panel* panel = nullptr;
  std::vector<Polyline> floor;  ///< the ground grid
  std::vector<Foot> feet;       ///< all that must lie within the plot
  bool rulers = false;

  // What follows holds for one scale; fit() sets it.
  double scale = 1;  ///< points per metre
  double step = 1;   ///< metres between ticks
  Box extent;        ///< of the content, in points from the world's origin on paper
  Point plot = Point::Zero();
  double left = 0, below = 0;  ///< room for the rulers' numbers
  std::vector<std::string> caption;

  double caption_height() const;
  double width() const;
  double height() const;
};

using Columns = std::vector<std::vector<Cell>>;

/// The plot's place relative to the world's origin on paper: the content is in its middle.
Box plot_box(const Cell& cell);

double width_of(const std::vector<Cell>& column);

/// Arranges the panels at the largest scale at which they fit a page of this size, and returns the
/// size that they take. Panels of one column share the range of the x axis, panels side by side
/// that of the y axis, where they have the same. Where not even the text fits the result is larger
/// than the page; it is never cut.
Point fit(Columns& columns, const Point& page);

}  // namespace beeline
