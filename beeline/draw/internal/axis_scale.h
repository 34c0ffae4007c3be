#pragma once

#include <string>
#include <vector>

#include <beeline/draw/drawing.h>

namespace beeline::internal {

constexpr Colour grid_grey{0.90, 0.91, 0.925};  ///< grid lines
constexpr Colour zero_grey{0.76, 0.78, 0.81};   ///< the grid line at zero
constexpr Colour frame_grey{0.55, 0.57, 0.60};  ///< frames and ticks
constexpr double tick_size = 7.5;               ///< font size of tick labels, points
constexpr double axis_name_size = 8.5;          ///< font size of axis names, points

/// The range of one axis. Tick labels are in units of ten to the power `exponent`.
struct Scale {
  double low = 0, high = 1;
  double step = 1;  ///< step between ticks: 1, 2 or 5 times a power of ten
  int exponent = 0;
};

/// Returns the scale from `low` to `high`, widened to a span of at least `min_span` and 1e-9 of
/// their size. Throws Error when one is not finite or above 1e150 in size.
Scale spanning(double low, double high, double min_span);

/// Sets the tick step to about `gap` points on a vertical axis of `length` points.
void set_upright_ticks(Scale& scale, double length, double gap);

/// Sets the tick step of a horizontal axis. It must also exceed the width of the labels.
void set_level_ticks(Scale& scale, double length, double gap);

/// Returns the multiples of the step on the scale; none when there would be more than 200.
std::vector<double> ticks(const Scale& scale);

/// Formats a tick label with the decimals that the step needs.
std::string tick_text(const Scale& scale, double value);
double widest_tick(const Scale& scale);  ///< width of the widest tick label, points

/// Formats a unit with a power of ten: "m" for exponent 0, otherwise "10⁻⁶ m".
std::string with_power(const std::string& unit, int exponent);

}  // namespace beeline::internal
