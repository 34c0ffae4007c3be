#pragma once

#include <string>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/symbols.h>

namespace beeline::internal {

constexpr double caption_size = 9, caption_leading = 12;  ///< points
constexpr double column_gap = 20, panel_gap = 14;         ///< between columns, and within one

/// The layout of a panel on paper.
struct Cell {
  const Panel* panel = nullptr;
  std::vector<Polyline> floor;        ///< the ground grid
  std::vector<Footprint> footprints;  ///< all content that must lie within the plot
  bool rulers = false;                ///< draw rulers
  bool scale_bar = false;             ///< draw the world's axes and a scale bar

  // The following members hold for one scale; fit() sets them.
  double scale = 1;  ///< points per metre
  double step = 1;   ///< metres between ticks
  PaperBox extent;   ///< of the content, points, relative to the world's origin on paper
  PaperPoint plot = PaperPoint::Zero();
  double left = 0, below = 0;  ///< sizes of the rulers' tick labels and names, points
  std::vector<std::string> caption;

  double caption_height() const;
  double width() const;
  double height() const;
};

using Columns = std::vector<std::vector<Cell>>;

/// Returns the plot's rectangle relative to the world's origin on paper, centred on the content.
PaperBox plot_box(const Cell& cell);

double width_of(const std::vector<Cell>& column);

/// Arranges the panels at the largest scale at which they fit a page of this size, and returns
/// their total size. Panels of one column with the same x axis share its range, and panels side by
/// side with the same y axis share that. When the text alone exceeds the page, the result is larger
/// than the page; nothing is cut off. With `fill` the plots are widened to the size of the page.
PaperPoint fit(Columns& columns, const PaperPoint& page, bool fill = false);

}  // namespace beeline::internal
