#include <cmath>
#include <numbers>

#include <beeline/pose/angle.h>

namespace beeline {

double wrap_angle(double radians) { return std::remainder(radians, 2 * std::numbers::pi); }

double angle_difference(double a, double b) { return wrap_angle(a - b); }

double nearest_turn(double radians, double reference) {
  return reference + angle_difference(radians, reference);
}

}  // namespace beeline
