#pragma once

#include <string>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Return the bytes of a PNG of 180 pixels per inch, and of a PDF, drawn by Cairo. They exist only
/// in builds with BEELINE_CAIRO.
std::string png_of(const Picture& picture);
std::string pdf_of(const Picture& picture);

/// Returns the rows of an image of the picture, times `scale` (pixels per point), from its upper
/// left corner. A pixel has four bytes: blue, green, red and an unused one.
std::string pixels_of(const Picture& picture, int width, int height, double scale);

}  // namespace beeline::internal
