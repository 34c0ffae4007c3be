#pragma once

#include <compare>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/symbols.h>

namespace beeline::internal {

constexpr double caption_size = 9, caption_leading = 12;  ///< points
constexpr double column_gap = 20, panel_gap = 14;  ///< gap between columns, and gap within a column

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
  PaperBox extent;   ///< extent of the content, points, relative to the world's origin on paper
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
/// side with the same y axis share the range of that axis. If the text alone exceeds the page, the
/// result is larger than the page; nothing is cut off. With `fill` the plots are widened to the
/// size of the page.
PaperPoint fit(Columns& columns, const PaperPoint& page, bool fill = false);

/// The source of a mark: marks of one source in two frames show the same thing.
struct MarkSource {
  enum class Kind : char { page, background, still, moving, label, caption };
  Kind kind = Kind::page;
  std::size_t panel = 0;
  std::size_t item = 0;  ///< index in the panel's drawing, or in the frame's drawing

  auto operator<=>(const MarkSource&) const = default;
};

/// A mark of one frame. It is drawn from the time `appears` on; see Item. Frames share the marks
/// that are the same in all of them: a scene may have thousands.
struct FrameMark {
  std::shared_ptr<const PaperMark> mark;
  MarkSource source;
  double appears = 0;
};

/// A figure's layout on a page; the figure must outlive it.
struct PageLayout {
  double width = 0, height = 0;
  struct PlacedCell {
    Cell cell;
    PaperPoint corner = PaperPoint::Zero();
    std::vector<FrameMark> background = {}, labels = {}, caption = {};
    /// The marks of each item of the panel's drawing.
    std::vector<std::vector<FrameMark>> still = {};
  };
  std::vector<PlacedCell> cells;
  std::vector<FrameMark> title;
};

/// Lays the figure out. Each panel has room for the items of all frames, because every panel shows
/// them beside its own drawing. Throws Error as compose() does.
PageLayout laid_out(const Figure& figure, std::span<const Drawing> frames = {});

/// Draws one frame; with null, the figure without a frame.
std::vector<FrameMark> frame_marks(const PageLayout& layout, const Drawing* frame);

}  // namespace beeline::internal
