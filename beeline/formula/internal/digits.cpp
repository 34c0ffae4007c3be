#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <version>

#include <beeline/formula/internal/digits.h>

namespace beeline::internal {

#ifdef __cpp_lib_to_chars
std::string shortest_digits(double value) {
  char buffer[64];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return std::string(buffer, end.ptr);
}

std::string rounded_digits(double value, int precision) {
  char buffer[64];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), value,
                                 std::chars_format::general, precision);
  return std::string(buffer, end.ptr);
}
#else  // libc++ 14, of the WebAssembly module, whose only locale is C
namespace {

std::string printed(const char* format, int precision, double value) {
  char buffer[512];
  const int length = std::snprintf(buffer, sizeof buffer, format, precision, value);
  return std::string(buffer, static_cast<std::size_t>(length));
}

}  // namespace

std::string shortest_digits(double value) {
  int precision = 0;
  std::string scientific = printed("%.*e", precision, value);
  while (precision < 16 && std::strtod(scientific.c_str(), nullptr) != value) {
    scientific = printed("%.*e", ++precision, value);
  }
  const std::size_t mark = scientific.find('e');
  if (mark == std::string::npos) return scientific;  // inf, nan
  const int exponent = std::atoi(scientific.c_str() + mark + 1);
  const std::string fixed = printed("%.*f", std::max(0, precision - exponent), value);
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

std::string rounded_digits(double value, int precision) {
  return printed("%.*g", precision, value);
}
#endif

}  // namespace beeline::internal
