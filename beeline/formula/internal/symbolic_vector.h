#pragma once

#include <array>

#include <beeline/formula/expression.h>

namespace beeline::internal {

// Vectors and rotations (their columns) of expressions, or of the nodes of a computation.

template <class Number>
using VectorIn = std::array<Number, 3>;
template <class Number>
using RotationIn = std::array<VectorIn<Number>, 3>;

using ExpressionVector = VectorIn<Expression>;
using ExpressionRotation = RotationIn<Expression>;

template <class Number>
VectorIn<Number> operator+(const VectorIn<Number>& a, const VectorIn<Number>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class Number>
VectorIn<Number> operator-(const VectorIn<Number>& a, const VectorIn<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Number>
VectorIn<Number> operator*(const Number& factor, const VectorIn<Number>& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

template <class Number>
VectorIn<Number> operator*(const RotationIn<Number>& r, const VectorIn<Number>& v) {
  const VectorIn<Number> x = v[0] * r[0], xy = x + v[1] * r[1];
  return xy + v[2] * r[2];
}

template <class Number>
RotationIn<Number> operator*(const RotationIn<Number>& a, const RotationIn<Number>& b) {
  return {a * b[0], a * b[1], a * b[2]};
}

template <class Number>
VectorIn<Number> cross(const VectorIn<Number>& a, const VectorIn<Number>& b) {
  VectorIn<Number> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result[i] = a[j] * b[k] - a[k] * b[j];
  }
  return result;
}

/// The product of the transpose of a rotation and a vector.
template <class Number>
VectorIn<Number> rotate_back(const RotationIn<Number>& r, const VectorIn<Number>& v) {
  VectorIn<Number> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = r[i][0] * v[0] + r[i][1] * v[1] + r[i][2] * v[2];
  return result;
}

/// The rotation about axis 0, 1 or 2 (x, y, z) by an angle with this cosine and sine.
template <class Number>
RotationIn<Number> axis_rotation(int axis, const Number& cosine, const Number& sine,
                                 const Number& zero = 0, const Number& one = 1) {
  const auto z = static_cast<std::size_t>(axis), x = (z + 1) % 3, y = (z + 2) % 3;
  RotationIn<Number> r{{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}}};
  r[z][z] = one;
  r[x][x] = cosine;
  r[x][y] = sine;
  r[y][x] = -sine;
  r[y][y] = cosine;
  return r;
}

inline ExpressionRotation identity_rotation() {
  return axis_rotation(2, Expression(1), Expression());
}

}  // namespace beeline::internal
