#pragma once

#include <array>

#include <beeline/formula/expression.h>

namespace beeline::internal {

using ExpressionVector = std::array<Expression, 3>;
using ExpressionRotation = std::array<ExpressionVector, 3>;  ///< its columns

ExpressionVector operator+(const ExpressionVector& a, const ExpressionVector& b);
ExpressionVector operator-(const ExpressionVector& a, const ExpressionVector& b);
ExpressionVector operator*(const Expression& factor, const ExpressionVector& v);
ExpressionVector cross(const ExpressionVector& a, const ExpressionVector& b);
Expression dot(const ExpressionVector& a, const ExpressionVector& b);
ExpressionVector operator*(const ExpressionRotation& r, const ExpressionVector& v);
ExpressionRotation operator*(const ExpressionRotation& a, const ExpressionRotation& b);
ExpressionVector transposed_times(const ExpressionRotation& r, const ExpressionVector& v);
ExpressionRotation identity_rotation();

/// The rotation about axis 0, 1 or 2 (x, y, z) by an angle with this cosine and sine.
ExpressionRotation axis_rotation(int axis, const Expression& cosine, const Expression& sine);

}  // namespace beeline::internal
