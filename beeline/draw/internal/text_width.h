#pragma once

#include <string_view>

namespace beeline::internal {

/// The typeface of all pictures: a sans serif with Greek letters and subscript digits.
constexpr const char* typeface = "DejaVu Sans";

/// Returns the width of a line of UTF-8 text in the typeface, without kerning: the sum of its
/// characters' advance widths times the font size. Characters outside the table are counted as
/// wide (East Asian scripts, symbols beyond the basic plane), zero (combining marks) or 0.7 em.
double text_width(std::string_view text, double size, bool bold);

}  // namespace beeline::internal
