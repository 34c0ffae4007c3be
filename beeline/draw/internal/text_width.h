#pragma once

#include <string_view>

namespace beeline::internal {

/// The typeface of all pictures: a sans serif with Greek letters and subscript digits.
constexpr const char* typeface = "DejaVu Sans";

/// Returns about the width of a line of UTF-8 text in the typeface, points: the sum of its
/// characters' advance widths times the font size. Basic Latin is exact. Other characters have the
/// width of most characters of their script, and bold text has 1.13 times the regular width.
double text_width(std::string_view text, double size, bool bold);

}  // namespace beeline::internal
