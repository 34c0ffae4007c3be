#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/axis_scale.h>
#include <beeline/draw/internal/projection.h>
#include <beeline/draw/internal/text.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

/// Returns the exponent, a multiple of three; 0 for sizes that read easily without one.
int exponent_of(const Scale& scale) {
  const double size = std::max(std::abs(scale.low), std::abs(scale.high));
  // A short range far from zero, such as seconds since 1970, needs all digits.
  if (scale.high - scale.low < 1e-4 * size && size >= 1 && size < 1e12) return 0;
  if (!(size > 0) || (size >= 5e-3 && size < 5e4)) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(size) / 3));
}

}  // namespace

Scale spanning(double low, double high, double min_span) {
  constexpr double largest = 1e150;
  for (const double value : {low, high}) {
    if (std::abs(value) <= largest) continue;  // the comparison is false for NaN
    throw Error("a curve has the value " + number(value) +
                "; values must be finite and within 1e150");
  }
  const double size = std::max(std::abs(low), std::abs(high));
  const double missing = std::max(min_span, 1e-9 * size) - (high - low);
  Scale scale{low, high};
  if (missing > 0) scale = {low - missing / 2, high + missing / 2};
  scale.step = round_step((scale.high - scale.low) / 4);
  scale.exponent = exponent_of(scale);
  return scale;
}

void set_upright_ticks(Scale& scale, double length, double gap) {
  scale.step = round_step((scale.high - scale.low) * std::min(1.0, gap / length));
}

void set_level_ticks(Scale& scale, double length, double gap) {
  set_upright_ticks(scale, length, gap);
  for (int widened = 0; widened < 8; ++widened) {
    const double on_paper = scale.step / (scale.high - scale.low) * length;
    if (on_paper >= widest_tick(scale) + 8) break;
    scale.step = round_step(1.5 * scale.step);
  }
}

std::vector<double> ticks(const Scale& scale) {
  const double first = std::ceil(scale.low / scale.step - 1e-9);
  const double last = std::floor(scale.high / scale.step + 1e-9);
  std::vector<double> values;
  if (!(last - first < 200)) return values;
  for (double k = first; k <= last; ++k) values.push_back(k * scale.step);
  return values;
}

std::string tick_text(const Scale& scale, double value) {
  const double unit = std::pow(10.0, scale.exponent);
  return fixed(value / unit, decimals_of(scale.step / unit));
}

double widest_tick(const Scale& scale) {
  double widest = 0;
  for (const double value : ticks(scale)) {
    widest = std::max(widest, text_size(tick_text(scale, value), tick_size).x());
  }
  return widest;
}

std::string with_power(const std::string& unit, int exponent) {
  if (exponent == 0) return unit;
  const std::string text = "10" + superscript(exponent);
  return unit.empty() ? text : text + " " + unit;
}

}  // namespace beeline::internal
