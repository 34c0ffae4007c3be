#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include <beeline/collision/scene.h>

#include <tests/random.h>

namespace beeline::testing {

constexpr int shape_kinds = std::variant_size_v<Shape::Body>;

/// The place of a kind in Shape::Body.
template <class Kind>
int place_of() {
  return static_cast<int>(Shape::Body(Kind()).index());
}

/// Gives a body random sizes.
struct RandomBody {
  Random& random;
  std::function<double()> length;

  void operator()(Sphere& sphere) const { sphere.radius = length(); }
  void operator()(Capsule& capsule) const { capsule = {length(), length()}; }
  void operator()(Box& box) const { box.size = {length(), length(), length()}; }
  void operator()(Cylinder& cylinder) const { cylinder = {length(), length()}; }
  void operator()(HalfSpace&) const {}
  void operator()(ConvexHull& hull) const {
    const int count = random.integer(1, 40);
    for (int i = 0; i < count; ++i) {
      hull.vertices.emplace_back(random.uniform(0, 1) * length(), random.uniform(-1, 1) * length(),
                                 random.uniform(-1, 1) * length());
    }
  }
};

template <std::size_t... i>
Shape::Body empty_body(int kind, std::index_sequence<i...>) {
  Shape::Body body;
  ((kind == static_cast<int>(i) ? void(body.emplace<i>()) : void()), ...);
  return body;
}

/// A shape of this kind, by its place in Shape::Body, of about this size and within about `spread`
/// of the origin: thin, on a grid with edges along the axes, or any.
inline Shape random_shape(Random& random, int kind, double size, double spread) {
  const int manner = random.integer(0, 3);
  const auto length = [&] {
    if (manner == 0) return 0.25 * size * random.integer(0, 4);        // on a grid
    if (manner == 1 && random.integer(0, 1) == 0) return 1e-4 * size;  // thin
    return random.uniform(0, size);
  };
  Shape shape;
  shape.body = empty_body(kind, std::make_index_sequence<shape_kinds>());
  std::visit(RandomBody{random, length}, shape.body);
  if (random.integer(0, 3) == 0) shape.padding = length() / 4;
  shape.pose = random.pose(spread);
  if (manner == 0) {
    shape.pose.linear().setIdentity();
    shape.pose.translation() = (4 * shape.pose.translation()).array().round().matrix() / 4;
  }
  return shape;
}

/// Moves the vertices of a hull, and its origin back: the hull moves by rounding alone.
inline void move_vertices(Shape& shape, const Vector3& by) {
  auto* const hull = std::get_if<ConvexHull>(&shape.body);
  if (hull == nullptr) return;
  for (Vector3& vertex : hull->vertices) vertex += by;
  shape.pose.translation() -= shape.pose.linear() * by;
}

/// The point of a shape that is nearest to `point`, by closed forms of its own. Not for hulls.
inline Vector3 projection(const Shape& shape, const Vector3& point) {
  Vector3 p = shape.pose.inverse() * point, on_core = p;
  double radius = shape.padding;
  if (const auto* sphere = std::get_if<Sphere>(&shape.body)) {
    on_core.setZero();
    radius += sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.body)) {
    const double half = capsule->length / 2;
    on_core = {0, 0, std::max(-half, std::min(half, p.z()))};
    radius += capsule->radius;
  } else if (const auto* box = std::get_if<Box>(&shape.body)) {
    for (int i = 0; i < 3; ++i) {
      on_core[i] = std::max(-box->size[i] / 2, std::min(box->size[i] / 2, p[i]));
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.body)) {
    const double half = cylinder->length / 2, across = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const double inwards = across > cylinder->radius ? cylinder->radius / across : 1;
    on_core = {inwards * p.x(), inwards * p.y(), std::max(-half, std::min(half, p.z()))};
  } else if (std::holds_alternative<HalfSpace>(shape.body)) {
    on_core.z() = std::min(p.z(), 0.0);
  } else {
    throw Error("no closed form of a projection on a " + kind_name(shape));
  }
  const double distance = (p - on_core).norm();
  if (distance <= radius) return point;
  return shape.pose * (on_core + radius / distance * (p - on_core));
}

inline bool is_hull(const Shape& shape) { return std::holds_alternative<ConvexHull>(shape.body); }

/// A distance that is at least the one of a point from the shape, for hulls at most: by planes in
/// many directions, of which the point is outside if the distance is above 0.
inline double distance_outside(const Shape& shape, const Vector3& point, Random& random) {
  if (!is_hull(shape)) return (point - projection(shape, point)).norm();
  const std::vector<Vector3>& vertices = std::get<ConvexHull>(shape.body).vertices;
  double outside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 direction = random.direction();
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vector3& vertex : vertices) {
      farthest = std::max(farthest, direction.dot(shape.pose * vertex));
    }
    outside = std::max(outside, direction.dot(point) - farthest - shape.padding);
  }
  return outside;
}

/// An upper bound of the distance of two shapes that converges to it: alternating projections
/// (Cheney and Goldstein, "Proximity maps for convex sets", 1959). Not for hulls.
inline double alternating_distance(const Shape& a, const Shape& b, int steps = 2000) {
  Vector3 on_b = b.pose.translation(), on_a = projection(a, on_b);
  for (int i = 0; i < steps; ++i) {
    on_b = projection(b, on_a);
    on_a = projection(a, on_b);
  }
  return (on_a - on_b).norm();
}

}  // namespace beeline::testing
