#pragma once

#include <functional>
#include <string>
#include <vector>

#include <beeline/draw/paper.h>

namespace beeline::internal {

constexpr double page_margin = 12;  ///< points

/// Draws the title in bold, centred below the upper margin of the page, in lines of at most `width`
/// points. Returns the y coordinate below it; the margin when the title is empty.
double draw_title(const std::string& title, double width, Picture& picture);

/// A panel or a chart on a page: its size, and the function that draws it with its upper left
/// corner at a point.
struct PageCell {
  PaperPoint size = PaperPoint::Zero();
  std::function<void(const PaperPoint& corner)> draw;
};

/// Draws cells below each other in columns side by side, `gap` points apart. `corner` is the upper
/// left corner of the whole.
void draw_columns(const std::vector<std::vector<PageCell>>& columns, PaperPoint corner, double gap);

}  // namespace beeline::internal
