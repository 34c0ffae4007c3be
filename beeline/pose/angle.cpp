#include <cmath>
#include <numbers>

#include <beeline/pose/angle.h>

namespace beeline {

double wrap_angle(double radians) { return std::remainder(radians, 2 * std::numbers::pi); }

double angle_difference(double a, double b) {
  return wrap_angle(wrap_angle(a) - wrap_angle(b));  // a - b could overflow, or lose b to rounding
}

double nearest_angle(double radians, double reference) {
  constexpr double two_pi = 2 * std::numbers::pi;
  return radians + two_pi * std::nearbyint((reference - radians) / two_pi);
}

}  // namespace beeline
