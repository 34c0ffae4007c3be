#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/paper.h>

namespace beeline {

/// The one typeface of all pictures: a sans serif with Greek letters and small digits.
constexpr const char* typeface = "DejaVu Sans";

/// Width and line height of a line of text, in points.
Point text_size(const std::string& text, double size, bool bold = false);

/// Text as it can be drawn: what is no UTF-8 and no printable character becomes a question mark.
std::string drawable(std::string_view text);

/// The text in lines no wider than `width` points, broken at blanks and at line feeds. A word that
/// is wider still is cut and ends in an ellipsis, and so does the twelfth line when there are more.
std::vector<std::string> wrapped(const std::string& text, double size, double width,
                                 bool bold = false);

/// A number with so many decimals, with a true minus sign; never "−0".
std::string fixed(double value, int decimals);

/// Degrees with at most one decimal, and the sign: 68.8°.
std::string degrees_text(double radians);

/// Small digits: ₁₂.
std::string subscript(int number);

}  // namespace beeline
