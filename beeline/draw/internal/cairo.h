#pragma once

#include <string>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Returns the bytes of a PNG of 180 pixels per inch, and of a PDF, drawn by Cairo. Only in builds
/// with BEELINE_CAIRO.
std::string png_of(const Drawing& drawing);
std::string pdf_of(const Drawing& drawing);

}  // namespace beeline::internal
