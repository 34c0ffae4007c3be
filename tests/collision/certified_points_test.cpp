#include <gtest/gtest.h>

#include <beeline/collision/internal/separation.h>

#include <tests/collision/point_in_hull.h>
#include <tests/collision/random_shape.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;

/// Makes a shape thirty times as long in one direction.
struct Lengthen {
  void operator()(Sphere&) const {}
  void operator()(HalfSpace&) const {}
  void operator()(Capsule& capsule) const { capsule.length *= 30; }
  void operator()(Box& box) const { box.size.x() *= 30; }
  void operator()(Cylinder& cylinder) const { cylinder.length *= 30; }
  void operator()(ConvexHull& hull) const {
    for (Vector3& vertex : hull.vertices) vertex.y() *= 30;
  }
};

/// How far a point is outside a shape.
double outside(const Shape& shape, const Vector3& point) {
  if (!testing::is_hull(shape)) return (point - testing::projection(shape, point)).norm();
  const Vector3 local = shape.pose.inverse() * point;
  const auto& vertices = std::get<ConvexHull>(shape.body).vertices;
  return std::max(0.0, testing::distance_from_hull(vertices, local) - shape.padding);
}

/// A random pair of two kinds: near, far, touching to a nanometre, on a grid along the axes, thin
/// or long.
std::pair<Shape, Shape> random_pair(Random& random, int first, int second) {
  const double size = std::pow(10, random.uniform(-2, 0));
  const double spread = size * (random.integer(0, 3) == 0 ? 30 : random.uniform(0.1, 3));
  Shape a = testing::random_shape(random, first, size, spread);
  Shape b = testing::random_shape(random, second, size, spread);
  if (random.integer(0, 3) == 0)
    std::visit(Lengthen{}, random.integer(0, 1) == 0 ? a.body : b.body);
  if (random.integer(0, 3) != 0) return {a, b};
  const Separation apart = separation(convex_body(a), convex_body(b));
  const double left = random.integer(-1, 1) * std::pow(10, random.uniform(-12, -6));
  b.pose.translation() -= (apart.lower - left) * apart.points.direction;
  return {a, b};
}

TEST(Separation, CarriesAPointOfEachBodyNearTheBound) {
  Random random;
  double worst_gap = 0, worst_outside = 0;
  for (int first = 0; first < testing::shape_kinds; ++first) {
    if (first == testing::place_of<HalfSpace>()) continue;
    for (int second = 0; second < testing::shape_kinds; ++second) {
      for (int i = 0; i < testing::cases(600); ++i) {
        const auto [a, b] = random_pair(random, first, second);
        const std::string what =
            kind_name(a) + " and " + kind_name(b) + ", case " + std::to_string(i);
        const Separation found = separation(convex_body(a), convex_body(b));
        const double out = std::max(outside(a, found.points.on_a), outside(b, found.points.on_b));
        EXPECT_LE(out, 1e-9) << what;
        const double between = (found.points.on_a - found.points.on_b).norm();
        const double gap = std::min(between, between - found.lower);
        EXPECT_LE(gap, 1e-6) << what;
        EXPECT_LE(found.lower, between) << what;
        worst_gap = std::max(worst_gap, gap);
        worst_outside = std::max(worst_outside, out);
      }
    }
  }
  std::cout << "the points are at most " << worst_gap << " m above the bound and " << worst_outside
            << " m outside their body\n";
}

/// Of a tiny body that touches a long one, the vertices of the difference are in small groups far
/// from each other.
TEST(Separation, IsAsExactForATinyBodyAtALongOne) {
  Random random;
  double worst = 0;
  for (int i = 0; i < testing::cases(6000); ++i) {
    const double tiny = std::pow(10, random.uniform(-5, -3)), length = random.uniform(1, 10);
    Shape a{Box{{tiny, tiny * random.integer(0, 1), tiny}}, random.pose(length)};
    Shape b{Capsule{0, length}, random.pose(length)};
    if (random.integer(0, 1) == 0) a.body = Cylinder{tiny, tiny / 2};
    if (random.integer(0, 2) == 0) b.body = Box{{length, length / 100, 0}};
    if (random.integer(0, 2) == 0) b.body = Cylinder{tiny * random.uniform(0.1, 1), length};
    for (int touch = 0; touch < 2; ++touch) {
      const Separation apart = separation(convex_body(a), convex_body(b));
      const double left = random.integer(-1, 1) * std::pow(10, random.uniform(-12, -7));
      b.pose.translation() -= (apart.lower - left) * apart.points.direction;
    }
    const Separation found = separation(convex_body(a), convex_body(b));
    const double between = (found.points.on_a - found.points.on_b).norm();
    const double gap = std::min(between, between - found.lower);
    EXPECT_LE(gap, 1e-7) << kind_name(a) << " and " << kind_name(b) << ", case " << i;
    worst = std::max(worst, gap);
  }
  std::cout << "the points are at most " << worst << " m above the bound\n";
}

}  // namespace
}  // namespace beeline
