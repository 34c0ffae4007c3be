#pragma once

#include <string>
#include <string_view>

#include <beeline/draw/figure.h>
#include <beeline/error.h>

namespace beeline {

enum class Format { svg, png, pdf };

/// Returns the format that the file extension names, in upper or lower case. Throws Error for any
/// extension other than svg, png and pdf.
Format format_of(std::string_view path);

/// Returns the bytes of the picture file; equal for equal figures. A PNG has 180 pixels per inch.
/// Throws Error where compose() does.
std::string render(const Picture& picture, Format format);
std::string render(const Figure& figure, Format format);

/// Writes the figure in the format that the path's extension names. Writes to a temporary file and
/// renames it, so that no incomplete file remains. Throws Error when the file cannot be written.
void save(const Figure& figure, const std::string& path);

}  // namespace beeline
