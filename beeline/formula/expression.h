#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <beeline/error.h>

namespace beeline {

/// A number a + b sqrt(2) + c sqrt(3) + d sqrt(6) with rational a, b, c, d. These numbers form a
/// field that contains the cosines and sines of all multiples of 15 degrees. Arithmetic is exact as
/// long as numerators and denominator fit 64 bits; a result that does not is a plain number.
class Coefficient {
 public:
  Coefficient(std::int64_t integer = 0) : parts_{integer, 0, 0, 0} {}  // NOLINT: implicit

  /// Returns (a + b sqrt(2) + c sqrt(3) + d sqrt(6)) / denominator. The denominator is positive.
  static Coefficient exactly(const std::array<std::int64_t, 4>& parts,
                             std::int64_t denominator = 1);
  static Coefficient plain(double value);                      ///< number that is not exact
  static Coefficient cosine_of_multiple_of_15_degrees(int k);  ///< cos(k * 15 degrees)
  static Coefficient sine_of_multiple_of_15_degrees(int k);    ///< sin(k * 15 degrees)

  bool exact() const { return exact_; }
  bool is_zero() const { return exact_ ? parts_ == std::array<std::int64_t, 4>{} : value_ == 0; }
  bool is_negative() const { return value() < 0; }
  double value() const;
  const std::array<std::int64_t, 4>& parts() const {
    return parts_;
  }  ///< a, b, c, d of an exact number
  std::int64_t denominator() const { return denominator_; }

  friend Coefficient operator+(const Coefficient& a, const Coefficient& b);
  friend Coefficient operator*(const Coefficient& a, const Coefficient& b);
  friend Coefficient operator-(const Coefficient& a) { return a * Coefficient(-1); }
  friend Coefficient operator-(const Coefficient& a, const Coefficient& b) { return a + -b; }
  bool operator==(const Coefficient&) const = default;

 private:
  std::array<std::int64_t, 4> parts_{};
  std::int64_t denominator_ = 1;
  double value_ = 0;  ///< value of a number that is not exact
  bool exact_ = true;
};

enum class SymbolKind {
  length,        ///< constant length of the arm, metres
  pitch,         ///< constant pitch of a helical joint, metres per radian
  angle,         ///< constant angle of the arm, rad
  joint_angle,   ///< coordinate of a revolute or helical joint, rad
  displacement,  ///< coordinate of a prismatic joint, metres
  rate           ///< time derivative of a coordinate
};

/// A named quantity of a formula: letter and subscript, such as a and 2 of the length a2.
struct Symbol {
  SymbolKind kind = SymbolKind::length;
  std::string letter;     ///< letter, such as a, alpha, q
  std::string subscript;  ///< subscript, such as 2, t
  double value = 0;       ///< value of a constant, m or rad; offset of a variable, see `ratio`
  /// Index in the configuration, for a variable or a rate; -1 for a constant.
  int coordinate = -1;
  /// Factor of the coordinate: a variable is ratio * q[coordinate] + value. Without a mimic joint
  /// they are 1 and 0.
  double ratio = 1;
  std::string meaning = {};  ///< meaning in words

  std::string name() const { return letter + subscript; }  ///< ASCII name, as in generated code
  /// Whether it is a coordinate of the configuration, and not the value of a mimic joint.
  bool is_coordinate() const {
    return coordinate >= 0 && kind != SymbolKind::rate && ratio == 1 && value == 0;
  }
};

/// An integer combination of angle symbols: multiples of symbol numbers, in ascending order. Angles
/// of one group share symbols, as the angles of joints with parallel axes do. Angles of different
/// groups have no symbol in common.
struct Angle {
  int group = 0;
  /// Pairs of a symbol and its multiple, which is not 0.
  std::vector<std::pair<int, int>> multiples = {};

  bool is_zero() const { return multiples.empty(); }
  bool operator==(const Angle&) const = default;
  friend bool operator<(const Angle& a, const Angle& b) {
    return std::tie(a.group, a.multiples) < std::tie(b.group, b.multiples);
  }
};
Angle operator+(const Angle& a, const Angle& b);  ///< both of the same group, or one zero
Angle operator*(int factor, const Angle& a);

/// The cosine or sine of an angle whose first multiple is positive.
struct Trig {
  Angle angle;
  bool sine = false;

  bool operator==(const Trig&) const = default;
  friend bool operator<(const Trig& a, const Trig& b) {
    return std::tie(a.angle, a.sine) < std::tie(b.angle, b.sine);
  }
};

/// A product of powers of symbols and of at most one cosine or sine for each group.
struct Monomial {
  /// Pairs of a symbol and its exponent, which is positive.
  std::vector<std::pair<int, int>> powers = {};
  std::vector<Trig> trigs = {};  ///< cosines and sines in ascending order of groups

  bool operator==(const Monomial&) const = default;
  friend bool operator<(const Monomial& a, const Monomial& b) {
    return std::tie(a.powers, a.trigs) < std::tie(b.powers, b.trigs);
  }
};

/// A polynomial in symbols and in cosines and sines. A product of two cosines or sines of one group
/// is replaced by a sum (cos a cos b = (cos(a - b) + cos(a + b)) / 2), so the terms are linearly
/// independent functions: two expressions are equal if and only if their terms are. In particular
/// cos^2 + sin^2 is 1, and sin(a + b) cos(a) - cos(a + b) sin(a) is sin(b).
class Expression {
 public:
  using Terms = std::map<Monomial, Coefficient>;

  Expression() = default;                                        ///< zero
  Expression(const Coefficient& coefficient);                    // NOLINT: implicit
  Expression(int integer) : Expression(Coefficient(integer)) {}  // NOLINT: implicit
  static Expression symbol(int number);
  static Expression cosine(const Angle& angle);
  static Expression sine(const Angle& angle);

  const Terms& terms() const { return terms_; }
  bool is_zero() const { return terms_.empty(); }
  std::size_t size()
      const;  ///< number of symbols in the written expression, and at least the number of its terms

  Expression& operator+=(const Expression& other);
  friend Expression operator+(Expression a, const Expression& b) { return a += b; }
  friend Expression operator-(const Expression& a) { return Expression(-1) * a; }
  friend Expression operator-(const Expression& a, const Expression& b) { return a + -b; }
  friend Expression operator*(const Expression& a, const Expression& b);
  bool operator==(const Expression&) const = default;

  /// Returns the partial derivative with respect to a symbol, which may be an angle.
  Expression derivative(int symbol) const;

  /// Returns the value for given values of all symbols, in the order of their numbers.
  double value(std::span<const double> symbols) const;

  /// Adds a term. The monomial must have the form that Monomial and Trig describe.
  void add(const Monomial& monomial, const Coefficient& coefficient);

 private:
  Terms terms_;
};

}  // namespace beeline
