#include <gtest/gtest.h>

#include <beeline/collision/internal/separation.h>

#include <tests/collision/body_over_tube.h>
#include <tests/collision/wide.h>

namespace beeline {

using namespace internal;

namespace {

using testing::BodyOverTube;
using testing::Random;
using testing::random_finite_kind;
using testing::Wide;
using testing::WideVector;

double highest(const BoundingCapsule& capsule, const Vector3& n) {
  return -lowest_along(capsule, -n);
}

TEST(BoundingCapsule, ContainsTheBodies) {
  Random random;
  for (int i = 0; i < testing::cases(3000); ++i) {
    const double size = std::pow(10, random.uniform(-6, 0));
    std::vector<ConvexBody> bodies;
    std::vector<Shape> shapes;  // hulls refer to their vertices
    std::vector<BoundingCapsule> capsules;
    for (int k = random.integer(1, 4); k > 0; --k) {
      shapes.push_back(testing::random_shape(random, random_finite_kind(random), size, 3 * size));
    }
    for (const Shape& shape : shapes) {
      bodies.push_back(convex_body(shape));
      capsules.push_back(capsule_around(bodies.back()));
    }
    const BoundingCapsule all = capsule_around(capsules);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      for (int j = 0; j < 20; ++j) {
        const Vector3 n = random.direction();
        const double reached = support(bodies[k], n), rounding = support_rounding(bodies[k]);
        EXPECT_LE(reached, highest(capsules[k], n) + rounding) << kind_name(shapes[k]);
        EXPECT_LE(reached, highest(all, n) + rounding) << kind_name(shapes[k]);
        if (!is_capsule(bodies[k])) continue;
        EXPECT_NEAR(reached, highest(capsules[k], n), rounding) << kind_name(shapes[k]);
      }
    }
  }
}

/// Points of the shape's core, among them those that are farthest from any segment.
std::vector<Vector3> outermost_points(const Shape& shape, Random& random) {
  std::vector<Vector3> points;
  if (const auto* const hull = std::get_if<ConvexHull>(&shape.body)) return hull->vertices;
  if (const auto* const box = std::get_if<Box>(&shape.body)) {
    for (int k = 0; k < 8; ++k) {
      const Vector3 signs(k % 2 * 2 - 1, k / 2 % 2 * 2 - 1, k / 4 * 2 - 1);
      points.emplace_back(signs.cwiseProduct(box->size) / 2);
    }
  } else if (const auto* const cylinder = std::get_if<Cylinder>(&shape.body)) {
    for (int k = 0; k < 8; ++k) {
      const double angle = random.uniform(-3.2, 3.2);
      points.emplace_back(cylinder->radius * std::cos(angle), cylinder->radius * std::sin(angle),
                          (k % 2 - 0.5) * cylinder->length);
    }
  }
  return points;
}

Wide distance_from_axis(const WideVector& point, const BoundingCapsule& capsule) {
  const WideVector axis = capsule.half_axis.cast<Wide>();
  const WideVector from = point - capsule.centre.cast<Wide>();
  const Wide square = axis.squaredNorm();
  const Wide t = square > 0 ? std::clamp<Wide>(from.dot(axis) / square, -1, 1) : 0;
  return std::sqrt((from - t * axis).squaredNorm());
}

/// Without any tolerance: the points that determine the radius are inside in more digits, too.
TEST(BoundingCapsule, IsRoundedOutwards) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  for (int i = 0; i < testing::cases(10'000); ++i) {
    const double size = std::pow(10, random.uniform(-6, 1));
    const double offset = random.integer(0, 1) == 0 ? 0 : std::pow(10, random.uniform(0, 5));
    const Vector3 moved = offset * random.direction();
    std::vector<BoundingCapsule> capsules;
    for (int k = random.integer(1, 3); k > 0; --k) {
      Shape shape = testing::random_shape(random, random_finite_kind(random), size, 3 * size);
      shape.pose.translation() += moved;
      if (random.integer(0, 1) == 0) testing::move_vertices(shape, offset * random.direction());
      capsules.push_back(capsule_around(convex_body(shape)));
      // A point of the rim itself is rounded.
      const Wide rim = std::holds_alternative<Cylinder>(shape.body) ? 1e-15 * size : 0;
      for (const Vector3& point : outermost_points(shape, random)) {
        const WideVector at = testing::wide(shape.pose) * point.cast<Wide>();
        EXPECT_LE(distance_from_axis(at, capsules.back()) + shape.padding,
                  capsules.back().radius + rim)
            << kind_name(shape) << " of " << number(size) << " m at " << number(offset) << " m";
      }
    }
    const BoundingCapsule all = capsule_around(capsules);
    for (const BoundingCapsule& capsule : capsules) {
      for (const double end : {-1.0, 1.0}) {
        const WideVector at = capsule.centre.cast<Wide>() + end * capsule.half_axis.cast<Wide>();
        EXPECT_LE(distance_from_axis(at, all) + capsule.radius, all.radius)
            << number(size) << " m at " << number(offset) << " m, case " << i;
      }
    }
  }
}

/// Nothing is proved with a capsule around a body with a number that is not finite.
TEST(BoundingCapsule, OfABodyThatIsNotFiniteContainsEverything) {
  Random random;
  const double infinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < testing::cases(600); ++i) {
    Shape shape = testing::random_shape(random, random_finite_kind(random), 1, 1);
    const double wrong = random.integer(0, 1) == 0 ? std::nan("") : infinity;
    ConvexBody body = convex_body(shape);
    auto* const hull = std::get_if<ConvexHull>(&shape.body);
    const int member = random.integer(0, 2);
    if (member == 0) {
      body.radius = wrong;
    } else if (member == 1 || (hull == nullptr && is_capsule(body))) {
      body.origin[random.integer(0, 2)] = wrong;
    } else if (hull == nullptr) {
      body.half_extents.z() = wrong;
    } else {
      const int vertices = static_cast<int>(hull->vertices.size());
      hull->vertices[static_cast<std::size_t>(random.integer(0, vertices - 1))].y() = wrong;
    }
    const BoundingCapsule capsule = capsule_around(body);
    EXPECT_EQ(capsule.radius, infinity) << kind_name(shape) << ", member " << member;
    EXPECT_EQ(lowest_along(capsule, random.direction()), -infinity);
    const BoundingCapsule finite{random.direction(), random.direction(), 0.1};
    EXPECT_EQ(capsule_around(std::vector{finite, capsule}).radius, infinity);
    BoundingCapsule not_finite = finite;
    not_finite.half_axis.x() = wrong;
    EXPECT_EQ(capsule_around(std::vector{not_finite, finite}).radius, infinity);
  }
}

TEST(MovingCapsule, BoundsTheMotionRelativeToAFrame) {
  Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const BodyOverTube over(random, true);
    const ChainMotion::Frame& fixed = over.motion.frame(over.first);
    const Vector3 n = random.direction();  // in the axes of the frame
    const Vector3 along = fixed.rotation * n;
    const double bound = highest_along(over.capsule, along) - along.dot(fixed.origin);
    for (int k = -4; k <= 4; ++k) {
      const ChainMotion still = over.at(k / 4.0, random);
      const ChainMotion::Frame& frame = still.frame(over.first);
      const Vector3 direction = frame.rotation * n;
      const ConvexBody at = in_world(still, {over.body, over.last});
      EXPECT_LE(support(at, direction) - direction.dot(frame.origin), bound + 1e-12)
          << "frame " << over.first << " of " << over.last;
    }
  }
}

}  // namespace
}  // namespace beeline
