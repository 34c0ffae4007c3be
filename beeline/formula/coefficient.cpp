#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <beeline/formula/expression.h>

namespace beeline {
namespace {

using Parts = std::array<std::int64_t, 4>;

/// Integer arithmetic that records whether a result exceeded 64 bits.
struct Checked {
  bool overflow = false;

  std::int64_t times(std::int64_t a, std::int64_t b) {
    std::int64_t product = 0;
    overflow = __builtin_mul_overflow(a, b, &product) || overflow;
    return product;
  }
  std::int64_t plus(std::int64_t a, std::int64_t b) {
    std::int64_t sum = 0;
    overflow = __builtin_add_overflow(a, b, &sum) || overflow;
    return sum;
  }
};

/// std::gcd() is not defined for the smallest integer, whose absolute value exceeds 64 bits.
bool has_absolute_value(std::int64_t n) { return n != std::numeric_limits<std::int64_t>::min(); }

/// The products of the basis 1, sqrt(2), sqrt(3), sqrt(6): factor and index of the result.
struct BasisProduct {
  std::int64_t factor;
  std::size_t index;
};
constexpr BasisProduct basis_products[4][4] = {{{1, 0}, {1, 1}, {1, 2}, {1, 3}},
                                               {{1, 1}, {2, 0}, {1, 3}, {2, 2}},
                                               {{1, 2}, {1, 3}, {3, 0}, {3, 1}},
                                               {{1, 3}, {2, 2}, {3, 1}, {6, 0}}};

double value_of(const Parts& parts, std::int64_t denominator) {
  constexpr double roots[] = {1, 1.4142135623730951, 1.7320508075688772, 2.449489742783178};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += static_cast<double>(parts[i]) * roots[i];
  return sum / static_cast<double>(denominator);
}

std::optional<Parts> product(const Parts& a, const Parts& b) {
  Parts parts{};
  Checked checked;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [factor, index] = basis_products[i][k];
      parts[index] = checked.plus(parts[index], checked.times(factor, checked.times(a[i], b[k])));
    }
  }
  return checked.overflow ? std::nullopt : std::optional(parts);
}

}  // namespace

Coefficient Coefficient::exactly(const Parts& parts, std::int64_t denominator) {
  if (denominator <= 0) throw Error("the denominator of a coefficient must be positive");
  Coefficient result;
  std::int64_t divisor = denominator;
  for (const std::int64_t part : parts) {
    if (!has_absolute_value(part)) return plain(value_of(parts, denominator));
    divisor = std::gcd(divisor, part);
  }
  for (std::size_t i = 0; i < 4; ++i) result.parts_[i] = parts[i] / divisor;
  result.denominator_ = denominator / divisor;
  return result;
}

Coefficient Coefficient::plain(double value) {
  if (std::abs(value) < 1e15 && value == std::round(value)) {
    return {static_cast<std::int64_t>(value)};
  }
  Coefficient result;
  result.value_ = value;
  result.exact_ = false;
  return result;
}

Coefficient Coefficient::cosine_of_multiple_of_15_degrees(int k) {
  const int folded = std::abs(k) % 24;
  const int m = folded > 12 ? 24 - folded : folded;  // cosine is even
  const std::int64_t sign = m > 6 ? -1 : 1;
  switch (m > 6 ? 12 - m : m) {
    case 0:
      return {sign};
    case 1:
      return exactly({0, sign, 0, sign}, 4);
    case 2:
      return exactly({0, 0, sign, 0}, 2);
    case 3:
      return exactly({0, sign, 0, 0}, 2);
    case 4:
      return exactly({sign, 0, 0, 0}, 2);
    case 5:
      return exactly({0, -sign, 0, sign}, 4);
    default:
      return {0};
  }
}

Coefficient Coefficient::sine_of_multiple_of_15_degrees(int k) {
  return cosine_of_multiple_of_15_degrees(k % 24 - 6);
}

double Coefficient::value() const { return exact_ ? value_of(parts_, denominator_) : value_; }

Coefficient operator+(const Coefficient& a, const Coefficient& b) {
  if (a.exact_ && b.exact_) {
    Checked checked;
    Parts parts{};
    for (std::size_t i = 0; i < 4; ++i) {
      parts[i] = checked.plus(checked.times(a.parts_[i], b.denominator_),
                              checked.times(b.parts_[i], a.denominator_));
    }
    const std::int64_t denominator = checked.times(a.denominator_, b.denominator_);
    if (!checked.overflow) return Coefficient::exactly(parts, denominator);
  }
  return Coefficient::plain(a.value() + b.value());
}

Coefficient operator*(const Coefficient& a, const Coefficient& b) {
  if (a.exact_ && b.exact_) {
    Checked checked;
    const std::int64_t denominator = checked.times(a.denominator_, b.denominator_);
    const std::optional<Parts> parts = product(a.parts_, b.parts_);
    if (parts && !checked.overflow) return Coefficient::exactly(*parts, denominator);
  }
  return Coefficient::plain(a.value() * b.value());
}

}  // namespace beeline
