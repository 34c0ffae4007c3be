#pragma once

#include <compare>
#include <span>
#include <vector>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/layout.h>

namespace beeline::internal {

/// What a mark was drawn for: marks of one source in two frames show the same thing.
struct MarkSource {
  enum class Kind : char { page, background, still, moving, label, caption };
  Kind kind = Kind::page;
  std::size_t panel = 0;
  std::size_t item = 0;  ///< in the panel's drawing, or in the frame's

  auto operator<=>(const MarkSource&) const = default;
};

/// A mark of one frame. It is drawn from the time `appears` on, see Item.
struct FrameMark {
  PaperMark mark;
  MarkSource source;
  double appears = 0;
};

/// A figure's layout on a page; the figure must outlive it.
struct PageLayout {
  double width = 0, height = 0;
  struct PlacedCell {
    Cell cell;
    PaperPoint corner = PaperPoint::Zero();
    std::vector<PaperMark> labels;
  };
  std::vector<PlacedCell> cells;
  std::vector<PaperMark> title;
};

/// Lays the figure out. Each panel has room for the items of all frames, which every panel shows
/// beside its own drawing. Throws Error as compose() does.
PageLayout laid_out(const Figure& figure, std::span<const Drawing> frames = {});

/// Draws one frame; null: the figure without any.
std::vector<FrameMark> frame_marks(const PageLayout& layout, const Drawing* frame);

}  // namespace beeline::internal
