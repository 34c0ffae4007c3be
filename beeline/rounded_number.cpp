#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include <beeline/error.h>

namespace beeline {
namespace {

std::string with_digits(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}

/// The unit of the last digit that is shown in a percentage.
double last_digit(double value) {
  const double size = std::abs(value);
  if (size >= 1000) return 1;
  if (size >= 1 || size == 0) return 0.1;
  return std::pow(10, std::floor(std::log10(size)) - 1);
}

/// The least number of units that is at least the value, except for the rounding of a product.
double units_at_least(double value, double unit) {
  const double units = value / unit;
  return std::ceil(units - std::numeric_limits<double>::epsilon() * std::abs(units));
}

std::string percent_text(double units, double unit) {
  constexpr int digits = 15;  // a product of doubles has a few more, by rounding
  return with_digits(units * unit, digits) + " %";
}

}  // namespace

std::string percent(double fraction) {
  constexpr double rounding_error = 5e-13;
  const double value = 100 * fraction;
  if (!std::isfinite(value)) return number(value) + " %";
  if (std::abs(fraction) < rounding_error) return "0 %";
  const double unit = last_digit(value);
  const double all = std::round(100 / unit);
  const double rounded = std::round(value / unit);
  // A fraction below 1 is not shown as 100 %.
  if (fraction < 1 - rounding_error && rounded >= all) {
    const double finer = std::pow(10, std::floor(std::log10(100 - value)));
    return percent_text(std::floor(value / finer), finer);
  }
  return percent_text(rounded, unit);
}

std::string percent_at_most(double fraction) {
  constexpr double slack = 1e-6;  // the same as in certificates
  const double value = 100 * fraction;
  if (!std::isfinite(value)) return number(value) + " %";
  if (fraction > 1 && fraction <= 1 + slack) return "100 %";
  const double unit = last_digit(value);
  return percent_text(units_at_least(value, unit), unit);
}

double rounded_up(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - (digits - 1));
  return units_at_least(value, unit) * unit;
}

double rounded_down(double value, int digits) { return -rounded_up(-value, digits); }

std::string number_at_least(double value) { return number(rounded_up(value, 6)); }

std::string number_apart(double value, double reference) {
  constexpr int usual = 6, all = std::numeric_limits<double>::max_digits10;
  int digits = usual;
  if (value != reference) {
    while (digits < all && with_digits(value, digits) == number(reference)) ++digits;
  }
  return with_digits(value, digits);
}

}  // namespace beeline
