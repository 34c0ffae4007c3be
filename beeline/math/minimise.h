#pragma once

#include <algorithm>
#include <limits>

namespace beeline::internal {

struct Minimum {
  double x = 0, value = std::numeric_limits<double>::infinity();
};

/// Minimises f over [low, high] by golden section (Press et al., *Numerical Recipes*, section
/// 10.2), f being unimodal there; each section shrinks the interval to 0.618 of its length. Finds
/// the minimiser to about the square root of rounding at best.
template <class Function>
Minimum golden_section(double low, double high, int sections, Function&& f) {
  constexpr double golden = 0.6180339887498949;
  double x = high - golden * (high - low), y = low + golden * (high - low);
  double at_x = f(x), at_y = f(y);
  for (int i = 0; i < sections; ++i) {
    if (at_x < at_y) {
      high = y;
      y = x;
      at_y = at_x;
      x = high - golden * (high - low);
      at_x = f(x);
    } else {
      low = x;
      x = y;
      at_x = at_y;
      y = low + golden * (high - low);
      at_y = f(y);
    }
  }
  return at_x < at_y ? Minimum{x, at_x} : Minimum{y, at_y};
}

/// Minimises f, which may have several local minima: evaluates it at the grid points point(0), ...,
/// point(intervals), which increase, and applies golden_section() between the neighbours of the
/// best. Returns the least value seen, the first of equal grid points.
template <class Point, class Function>
Minimum scan_and_refine(int intervals, Point&& point, int sections, Function&& f) {
  Minimum best;
  int index = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double x = point(i), value = f(x);
    if (!(value < best.value) && i > 0) continue;
    best = {x, value};
    index = i;
  }
  const Minimum refined = golden_section(point(std::max(index - 1, 0)),
                                         point(std::min(index + 1, intervals)), sections, f);
  return refined.value < best.value ? refined : best;
}

/// The same with equal intervals over [low, high].
template <class Function>
Minimum scan_and_refine(double low, double high, int intervals, int sections, Function&& f) {
  const auto point = [=](int i) { return low + (high - low) * i / intervals; };
  return scan_and_refine(intervals, point, sections, f);
}

}  // namespace beeline::internal
