#pragma once

#include <utility>
#include <vector>

#include <beeline/formula/expression.h>

namespace beeline::internal {

/// A formula as it is written: sums of products of factors.
struct Tree {
  enum class Kind {
    number,       ///< coefficient
    symbol,       ///< symbol
    trig,         ///< cosine or sine
    sum,          ///< sum of the parts
    product,      ///< coefficient times the parts
    power,        ///< first part to the power `exponent`
    quotient,     ///< first part divided by the second part
    arctangent,   ///< atan2 of the first part, y, and the second, x
    signed_root,  ///< plus or minus the square root of the first part: the branches of an inverse
    angle         ///< coefficient * 15 degrees
  };

  Kind kind = Kind::number;
  Coefficient coefficient = 1;
  int symbol = -1;
  Trig trig = {};
  int exponent = 1;
  std::vector<Tree> parts = {};

  bool is_zero() const { return kind == Kind::number && coefficient.is_zero(); }
};

/// Writes an expression with common factors before brackets, beginning with the factor of the most
/// terms (a multivariate Horner form). Sums of cosines that equal products are written as products.
Tree factored(const Expression& expression);

/// Returns the value of a tree. `leaf(tree)` is the value of a tree that is no sum, product or
/// power, and `number(coefficient)` is the value of a coefficient.
template <class Value>
Value evaluated(const Tree& tree, const auto& number, const auto& leaf) {
  const auto part = [&](const Tree& each) { return evaluated<Value>(each, number, leaf); };
  if (tree.kind == Tree::Kind::sum) {
    Value sum = number(0);
    for (const Tree& each : tree.parts) sum = sum + part(each);
    return sum;
  }
  if (tree.kind == Tree::Kind::product) {
    Value product = number(tree.coefficient);
    for (const Tree& each : tree.parts) product = product * part(each);
    return product;
  }
  if (tree.kind == Tree::Kind::power) {
    Value power = number(1);
    for (int k = 0; k < tree.exponent; ++k) power = power * part(tree.parts.front());
    return power;
  }
  return tree.kind == Tree::Kind::number ? Value(number(tree.coefficient)) : leaf(tree);
}

/// Returns the expression that a tree of numbers, symbols, cosines, sums, products and powers
/// writes.
Expression expression_of(const Tree& tree);

}  // namespace beeline::internal
