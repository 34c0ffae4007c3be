#pragma once

#include <string>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Returns the bytes of a PNG of 180 pixels per inch, and of a PDF, drawn by Cairo. Only in builds
/// with BEELINE_CAIRO.
std::string png_of(const Picture& picture);
std::string pdf_of(const Picture& picture);

/// Returns the rows of an image of the picture, times `scale` (pixels per point), from its upper
/// left corner; four bytes a pixel: blue, green, red and one that is not used.
std::string pixels_of(const Picture& picture, int width, int height, double scale);

}  // namespace beeline::internal
