#include <charconv>

#include <beeline/read/rounded.h>

namespace beeline {
namespace {

double rounded(double value, int digits) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value,
                                 std::chars_format::scientific, digits - 1)
                       .ptr;
  double result = value;
  std::from_chars(buffer, end, result);
  return result + 0.0;
}

}  // namespace

Vector3 rounded(const Vector3& v, int digits) {
  return {rounded(v.x(), digits), rounded(v.y(), digits), rounded(v.z(), digits)};
}

}  // namespace beeline
