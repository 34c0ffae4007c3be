#pragma once

#include <string>

#include <beeline/draw/paper.h>

namespace beeline::internal {

constexpr double page_margin = 12;  ///< points

/// Draws the title in bold, centred below the upper margin of the page, in lines of at most `width`
/// points. Returns the y coordinate below it; the margin when the title is empty.
double draw_title(const std::string& title, double width, Picture& picture);

}  // namespace beeline::internal
