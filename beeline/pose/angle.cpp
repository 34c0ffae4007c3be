#include <cmath>

#include <beeline/math/revolution.h>
#include <beeline/pose/angle.h>

namespace beeline {

double wrap_angle(double radians) { return std::remainder(radians, internal::revolution); }

double angle_difference(double a, double b) {
  return wrap_angle(wrap_angle(a) - wrap_angle(b));  // a - b could overflow, or lose b to rounding
}

double nearest_angle(double radians, double reference) {
  return radians +
         internal::revolution * std::nearbyint((reference - radians) / internal::revolution);
}

}  // namespace beeline
