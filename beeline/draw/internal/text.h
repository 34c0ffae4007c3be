#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Returns the width and line height of a line of text, points.
PaperPoint text_size(const std::string& text, double size, bool bold = false);

/// Replaces every byte that is not part of a printable UTF-8 character by a question mark.
std::string drawable(std::string_view text);

/// Breaks the text at spaces and line feeds into lines of at most `width` points. A wider word is
/// cut and ends in an ellipsis, as does the twelfth line if there are more.
std::vector<std::string> wrapped(const std::string& text, double size, double width,
                                 bool bold = false);

/// Breaks the text into the same number of lines, each as short as possible, so that no last line
/// holds a single word.
std::vector<std::string> balanced(const std::string& text, double size, double width,
                                  bool bold = false);

/// Returns the first line of the text that fits the width, with an ellipsis when it is cut.
std::string cut_to(const std::string& text, double size, double width, bool bold = false);

/// Formats a number with a fixed number of decimals and a typographic minus sign; never "−0".
std::string fixed(double value, int decimals);

/// Formats an angle in degrees with at most one decimal: 68.8°.
std::string degrees_text(double radians);

/// Formats a number in subscript digits: ₁₂.
std::string subscript(int number);

/// Formats a number in superscript digits: ⁻¹².
std::string superscript(int number);

}  // namespace beeline::internal
