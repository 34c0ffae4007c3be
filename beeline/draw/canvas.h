#pragma once

#include <string>
#include <string_view>

#include <beeline/draw/figure.h>

namespace beeline {

enum class Format { svg, png, pdf };

/// By the file's extension, in upper or lower case. Throws Error for any but svg, png and pdf.
Format format_of(std::string_view path);

/// The bytes of a file: always the same for the same figure. A PNG has 180 pixels an inch.
std::string render(const Drawing& drawing, Format format);
std::string render(const Figure& figure, Format format);

/// Writes the figure in the format that the path's extension names. Nothing is left half-written.
void save(const Figure& figure, const std::string& path);

}  // namespace beeline
