#pragma once

#include <string>
#include <vector>

namespace beeline {

/// What one axis of a chart spans. Numbers are written in units of ten to the power `exponent`.
struct Scale {
  double low = 0, high = 1;
  double step = 1;  ///< between ticks: 1, 2 or 5 times a power of ten
  int exponent = 0;
};

/// The least span around both, widened to `least` at least and by what rounding loses. Throws
/// Error when one is not finite or its size is above 1e150.
Scale spanning(double low, double high, double least);

/// Ticks about `gap` points apart on an axis of `length` points.
void set_upright_ticks(Scale& scale, double length, double gap);

/// The same for numbers beside each other: wide enough for them.
void set_level_ticks(Scale& scale, double length, double gap);

std::vector<double> ticks(const Scale& scale);
std::string tick_text(const Scale& scale, double value);
double widest_tick(const Scale& scale);

/// "m" or, with an exponent, "10⁻⁶ m".
std::string with_power(const std::string& unit, int exponent);

constexpr double tick_size = 7.5;  ///< of the numbers, points

}  // namespace beeline
