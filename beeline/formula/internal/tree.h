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
    sum,          ///< of the parts
    product,      ///< coefficient times the parts
    power,        ///< first part to the power `exponent`
    quotient,     ///< first part over second part
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

/// Writes an expression with common factors before brackets, the factor of most terms first
/// (a multivariate Horner form), and sums of cosines that are products as products.
Tree factored(const Expression& expression);

/// The expression that a tree of numbers, symbols, cosines, sums, products and powers writes.
Expression expression_of(const Tree& tree);

/// The number of multiplications and additions that a tree needs as it is written; a cosine or sine
/// counts as neither.
struct Operations {
  int multiplications = 0, additions = 0;
};
Operations operations(const Tree& tree);

}  // namespace beeline::internal
