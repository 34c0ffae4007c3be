#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/bounding_capsule.h>

namespace beeline::internal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double outwards = 1 + 1e-12;
constexpr double rounding = 4e-15;  // relative, of positions that are sums of a few products

/// A ball that a capsule is to contain.
struct Ball {
  Vector3 centre;
  double radius;
};

double distance_from_segment(const Vector3& point, const BoundingCapsule& capsule) {
  const Vector3 beside = point - capsule.centre;
  const double length = capsule.half_axis.squaredNorm();
  const double t = length > 0 ? std::clamp(beside.dot(capsule.half_axis) / length, -1.0, 1.0) : 0;
  return (beside - t * capsule.half_axis).norm();
}

/// The direction along which the centres are spread most, and two directions across it.
Rotation principal_axes(const std::vector<Ball>& balls) {
  Vector3 mean = Vector3::Zero();
  for (const Ball& ball : balls) mean += ball.centre / static_cast<double>(balls.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Ball& ball : balls) {
    spread += (ball.centre - mean) * (ball.centre - mean).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread)
      .eigenvectors();  // the last one is largest
}

/// The least radius with which the capsule contains the balls; infinite if it is not a number.
double radius_around(const std::vector<Ball>& balls, const BoundingCapsule& capsule) {
  double radius = 0;
  for (const Ball& ball : balls) {
    const double farthest = distance_from_segment(ball.centre, capsule) + ball.radius;
    if (!std::isfinite(farthest)) return infinity;
    radius = std::max(radius, farthest);
  }
  return radius;
}

/// The capsule, or one that contains everything if not all of its numbers are finite.
BoundingCapsule finite_or_everything(const BoundingCapsule& capsule) {
  if (std::isfinite(magnitude(capsule))) return capsule;
  return {.radius = infinity};
}

/// The capsule is along the principal axis, through the middle of the balls in the plane
/// perpendicular to it. Whatever the axis is, the radius is computed from all balls.
BoundingCapsule around_balls(const std::vector<Ball>& balls) {
  const Rotation axes = principal_axes(balls);
  Vector3 lower = Vector3::Constant(infinity), upper = -lower;
  for (const Ball& ball : balls) {
    const Vector3 at = axes.transpose() * ball.centre;
    lower = lower.cwiseMin((at.array() - ball.radius).matrix());
    upper = upper.cwiseMax((at.array() + ball.radius).matrix());
  }
  const Vector3 half_extents = (upper - lower) / 2;
  const double half_width = std::max(half_extents.x(), half_extents.y());
  BoundingCapsule best{.radius = infinity};
  double least = infinity;
  // The corners of a long box may be nearer to the ends of a segment that is shorter by less than
  // half the width.
  for (const double shortened : {1.0, 0.4, 0.0}) {
    const double half_length = std::max(0.0, half_extents.z() - shortened * half_width);
    BoundingCapsule capsule{.centre = axes * ((lower + upper) / 2),
                            .half_axis = half_length * axes.col(2)};
    capsule.radius = radius_around(balls, capsule);
    const double excess = capsule.radius + capsule.size();
    if (excess < least) least = excess, best = capsule;
  }
  best.radius = outwards * best.radius + rounding * magnitude(best);
  return finite_or_everything(best);
}

/// The same around the balls of a body, whose positions are rounded.
BoundingCapsule around_balls_of(const ConvexBody& body, const std::vector<Ball>& balls) {
  BoundingCapsule capsule = around_balls(balls);
  capsule.radius += rounding * magnitude(body);
  return finite_or_everything(capsule);
}

std::vector<Ball> corners_of(const ConvexBody& box) {
  std::vector<Ball> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 signs((corner & 1) * 2 - 1, (corner & 2) - 1, ((corner >> 2) & 1) * 2 - 1);
    corners.push_back({box.origin + box.axes * box.half_extents.cwiseProduct(signs), box.radius});
  }
  return corners;
}

}  // namespace

BoundingCapsule capsule_around(const ConvexBody& body) {
  switch (body.core) {
    case ConvexBody::Core::point:
    case ConvexBody::Core::segment:
      return finite_or_everything(
          {body.origin, body.half_extents.z() * body.axes.col(2), body.radius});
    case ConvexBody::Core::cylinder: {
      const double radius = body.half_extents.x(), half_length = body.half_extents.z();
      const double half_axis = std::max(0.0, half_length - 0.4 * radius);
      const double to_rim = std::hypot(radius, half_length - half_axis);
      return finite_or_everything({body.origin, half_axis * body.axes.col(2),
                                   outwards * (to_rim + body.radius) + rounding * magnitude(body)});
    }
    case ConvexBody::Core::box:
      return around_balls_of(body, corners_of(body));
    case ConvexBody::Core::hull: {
      std::vector<Ball> balls;
      for (const Vector3& vertex : body.vertices) {
        balls.push_back({body.origin + body.axes * vertex, body.radius});
      }
      return around_balls_of(body, balls);
    }
    case ConvexBody::Core::half_space:
      break;
  }
  throw Error("no capsule contains a half-space");
}

BoundingCapsule capsule_around(const std::vector<BoundingCapsule>& capsules) {
  std::vector<Ball> balls;
  for (const BoundingCapsule& capsule : capsules) {
    balls.push_back({capsule.centre + capsule.half_axis, capsule.radius});
    balls.push_back({capsule.centre - capsule.half_axis, capsule.radius});
  }
  return around_balls(balls);
}

double estimated_excess(const BoundingCapsule& capsule, const ConvexBody& body) {
  double most = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i steps(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const Vector3 direction = steps.cast<double>();
    if (direction.isZero(0)) continue;
    const Vector3 n = direction.normalized();
    const double of_capsule =
        n.dot(capsule.centre) + std::abs(n.dot(capsule.half_axis)) + capsule.radius;
    most = std::max(most, of_capsule - support(body, n));
  }
  return most;
}

bool is_capsule(const ConvexBody& body) {
  return body.core == ConvexBody::Core::point || body.core == ConvexBody::Core::segment;
}

/// Ericson, "Real-Time Collision Detection" (2005), section 5.1.9.
SegmentPoints nearest_on_segments(const BoundingCapsule& a, const BoundingCapsule& b) {
  const Vector3 &u = a.half_axis, &v = b.half_axis;
  const Vector3 between = a.centre - b.centre;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double ur = u.dot(between), vr = v.dot(between);
  const auto on_unit = [](double value, double size) {
    return size > 0 ? std::clamp(value / size, -1.0, 1.0) : 0.0;
  };
  double s = on_unit(uv * vr - ur * vv, uu * vv - uv * uv);
  const double t = on_unit(uv * s + vr, vv);
  s = on_unit(uv * t - ur, uu);
  return {a.centre + s * u, b.centre + t * v};
}

double magnitude(const BoundingCapsule& capsule) {
  return capsule.centre.cwiseAbs().sum() + capsule.half_axis.cwiseAbs().sum() + capsule.radius;
}

}  // namespace beeline::internal
