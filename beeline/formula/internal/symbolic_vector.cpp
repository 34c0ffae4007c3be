#include <beeline/formula/internal/symbolic_vector.h>

namespace beeline::internal {

ExpressionVector operator+(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

ExpressionVector operator-(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

ExpressionVector operator*(const Expression& factor, const ExpressionVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}

ExpressionVector cross(const ExpressionVector& a, const ExpressionVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Expression dot(const ExpressionVector& a, const ExpressionVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

ExpressionVector operator*(const ExpressionRotation& r, const ExpressionVector& v) {
  return v[0] * r[0] + v[1] * r[1] + v[2] * r[2];
}

ExpressionRotation operator*(const ExpressionRotation& a, const ExpressionRotation& b) {
  return {a * b[0], a * b[1], a * b[2]};
}

ExpressionVector transposed_times(const ExpressionRotation& r, const ExpressionVector& v) {
  return {dot(r[0], v), dot(r[1], v), dot(r[2], v)};
}

ExpressionRotation identity_rotation() {
  ExpressionRotation r;
  for (std::size_t i = 0; i < 3; ++i) r[i][i] = 1;
  return r;
}

ExpressionRotation axis_rotation(int axis, const Expression& cosine, const Expression& sine) {
  const auto z = static_cast<std::size_t>(axis), x = (z + 1) % 3, y = (z + 2) % 3;
  ExpressionRotation r;
  r[z][z] = 1;
  r[x][x] = cosine;
  r[x][y] = sine;
  r[y][x] = -sine;
  r[y][y] = cosine;
  return r;
}

}  // namespace beeline::internal
