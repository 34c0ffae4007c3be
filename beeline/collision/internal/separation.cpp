#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/separation.h>

namespace beeline::internal {
namespace {

/// Returns the point of the body nearest to `point`, to rounding. A point of a body without
/// projection is a weighted mean of vertices already.
Vector3 moved_into_body(const ConvexBody& body, const Vector3& point) {
  if (!has_projection(body.core)) return point;
  const Vector3 on_core = projection_on_core(body, point);
  const Vector3 outwards = point - on_core;
  const double distance = outwards.norm();
  return distance <= body.radius ? point : Vector3(on_core + body.radius / distance * outwards);
}

}  // namespace

double separation_rounding(const ConvexBody& a, const ConvexBody& b) {
  // A support value is a sum of at most twelve products, each of numbers of at most this size.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double size = a.centre.cwiseAbs().sum() + b.centre.cwiseAbs().sum() + 2 * a.bound +
                      (b.core == ConvexBody::Core::half_space ? b.radius : 2 * b.bound);
  return 32 * epsilon * size;
}

Separation separation(const ConvexBody& a, const ConvexBody& b, const Vector3& guess) {
  Separation found{.points = nearest_points(a, b, guess)};
  const double rounding = separation_rounding(a, b);
  const Vector3& direction = found.points.direction;
  found.lower = -support(b, -direction) - support(a, direction) - rounding;
  found.points.on_a = moved_into_body(a, found.points.on_a);
  found.points.on_b = moved_into_body(b, found.points.on_b);
  found.upper = (found.points.on_a - found.points.on_b).norm() + rounding;
  return found;
}

}  // namespace beeline::internal
