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

Separation separation(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                      double tolerance, SearchStart* start) {
  Separation found{.points = nearest_points(a, b, guess, tolerance, start)};
  const double rounding = support_rounding(a) + support_rounding(b);
  const Vector3& direction = found.points.direction;
  found.lower = -support(b, -direction) - support(a, direction) - rounding;
  found.points.on_a = moved_into_body(a, found.points.on_a);
  found.points.on_b = moved_into_body(b, found.points.on_b);
  found.upper = (found.points.on_a - found.points.on_b).norm() + rounding;
  return found;
}

}  // namespace beeline::internal
