#pragma once

#include <string>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Returns the drawing as an SVG file. Shapes are rounded to a hundredth of a point. Texts are text
/// in the typeface; a viewer that lacks it uses Verdana, which is as wide, or another sans serif.
/// Throws Error for a coordinate that is not finite or above 1e9 points.
std::string svg_of(const Picture& picture);

/// The parts of a file, for animations. A file is svg_begin(), elements, svg_end.
std::string svg_begin(const Picture& page);
inline constexpr const char* svg_end = "</g>\n</svg>\n";

/// Returns a number with at most two decimals: "12.5". Throws Error as svg_of() does.
std::string svg_number(double value);

/// Returns a path's attribute `d`: "M1 2L3 4".
std::string path_data(const PaperPath& path);

/// Returns a colour without its opacity: "#d32126".
std::string svg_colour(const Colour& colour);

/// Returns the element of a mark with these child elements, such as animations of it.
std::string svg_element(const PaperMark& mark, const std::string& children = "");

}  // namespace beeline::internal
