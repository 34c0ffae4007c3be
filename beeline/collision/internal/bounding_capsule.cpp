#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/bounding_capsule.h>

namespace beeline::internal {
namespace {

constexpr double larger = 1 + 1e-12;
constexpr double rounding = 4e-15;  // relative, of positions that are sums of a few products

/// A ball that a capsule is to contain.
struct Ball {
  Vector3 centre;
  double radius;
};

double distance_from_segment(const Vector3& point, const BoundingCapsule& capsule) {
  const Vector3 beside = point - capsule.centre;
  const double length = capsule.half.squaredNorm();
  const double t = length > 0 ? std::clamp(beside.dot(capsule.half) / length, -1.0, 1.0) : 0;
  return (beside - t * capsule.half).norm();
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

/// The capsule is along the principal axis, through the middle of the balls across it. Whatever the
/// axis is, the radius is computed from all balls.
BoundingCapsule around_balls(const std::vector<Ball>& balls) {
  const Rotation axes = principal_axes(balls);
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const Ball& ball : balls) {
    const Vector3 at = axes.transpose() * ball.centre;
    lower = lower.cwiseMin((at.array() - ball.radius).matrix());
    upper = upper.cwiseMax((at.array() + ball.radius).matrix());
  }
  const Vector3 half = (upper - lower) / 2;
  const double across = std::max(half.x(), half.y());
  BoundingCapsule best;
  double least = std::numeric_limits<double>::infinity();
  // The corners of a long box are nearer to a shorter segment's ends than the radius across.
  for (const double shortened : {1.0, 0.4, 0.0}) {
    BoundingCapsule capsule{.centre = axes * ((lower + upper) / 2),
                            .half = axes.col(2) * std::max(0.0, half.z() - shortened * across)};
    for (const Ball& ball : balls) {
      capsule.radius =
          std::max(capsule.radius, distance_from_segment(ball.centre, capsule) + ball.radius);
    }
    const double excess = capsule.radius + capsule.size();
    if (excess < least) least = excess, best = capsule;
  }
  best.radius = larger * best.radius + rounding * magnitude(best);
  return best;
}

/// The same around the balls of a body, whose positions are rounded.
BoundingCapsule around_balls_of(const ConvexBody& body, const std::vector<Ball>& balls) {
  BoundingCapsule capsule = around_balls(balls);
  capsule.radius += rounding * magnitude(body);
  return capsule;
}

std::vector<Ball> corners_of(const ConvexBody& box) {
  std::vector<Ball> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 signs((corner & 1) * 2 - 1, (corner & 2) - 1, ((corner >> 2) & 1) * 2 - 1);
    corners.push_back({box.origin + box.axes * box.half.cwiseProduct(signs), box.radius});
  }
  return corners;
}

}  // namespace

BoundingCapsule capsule_around(const ConvexBody& body) {
  switch (body.core) {
    case ConvexBody::Core::point:
    case ConvexBody::Core::segment:
      return {body.origin, body.half.z() * body.axes.col(2), body.radius};
    case ConvexBody::Core::cylinder: {
      const double across = body.half.x(), along = std::max(0.0, body.half.z() - 0.4 * across);
      return {body.origin, along * body.axes.col(2),
              larger * (std::hypot(across, body.half.z() - along) + body.radius) +
                  rounding * magnitude(body)};
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
    balls.push_back({capsule.centre + capsule.half, capsule.radius});
    balls.push_back({capsule.centre - capsule.half, capsule.radius});
  }
  return around_balls(balls);
}

bool is_capsule(const ConvexBody& body) {
  return body.core == ConvexBody::Core::point || body.core == ConvexBody::Core::segment;
}

/// Ericson, "Real-Time Collision Detection" (2005), section 5.1.9.
SegmentPoints nearest_on_segments(const BoundingCapsule& a, const BoundingCapsule& b) {
  const Vector3 &u = a.half, &v = b.half;
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
  return capsule.centre.cwiseAbs().sum() + capsule.half.cwiseAbs().sum() + capsule.radius;
}

}  // namespace beeline::internal
