#include <gtest/gtest.h>

#include <beeline/collision/internal/separation.h>

#include <tests/collision/random_shape.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;

/// Calls `check` with random pairs of every two kinds; the first is no half-space.
template <class Check>
void for_random_pairs(Random& random, int count, Check check) {
  for (int first = 0; first < testing::shape_kinds; ++first) {
    if (first == testing::place_of<HalfSpace>()) continue;
    for (int second = 0; second < testing::shape_kinds; ++second) {
      for (int i = 0; i < testing::cases(count); ++i) {
        const double sizes[] = {1e-3, 0.1, 1, 10};
        const double size = sizes[random.integer(0, 3)];
        const double spread = size * random.uniform(0.1, 3);
        check(testing::random_shape(random, first, size, spread),
              testing::random_shape(random, second, random.integer(0, 1) == 0 ? size : size / 100,
                                    spread));
      }
    }
  }
}

std::string described(const Shape& a, const Shape& b) {
  return kind_name(a) + " and " + kind_name(b);
}

TEST(Separation, BoundsTheDistanceFromBothSides) {
  Random random;
  double worst = 0;
  for_random_pairs(random, 300, [&](const Shape& a, const Shape& b) {
    const ConvexBody first = convex_body(a), second = convex_body(b);
    const Separation found = separation(first, second, second.origin - first.origin);
    ASSERT_LE(found.lower, found.upper) << described(a, b);
    const double size = first.bound + (std::isfinite(second.bound) ? second.bound : 0) +
                        first.centre.norm() + second.centre.norm();
    EXPECT_LE(testing::distance_outside(a, found.points.on_a, random), 1e-13 * size)
        << described(a, b);
    EXPECT_LE(testing::distance_outside(b, found.points.on_b, random), 1e-13 * size)
        << described(a, b);
    EXPECT_NEAR(found.points.direction.norm(), 1, 1e-14);
    // Where the bodies overlap, the upper bound is 0 to rounding.
    worst = std::max(worst, std::min(found.upper, found.upper - found.lower));
    EXPECT_LE(std::min(found.upper, found.upper - found.lower), 1e-6) << described(a, b);
  });
  RecordProperty("largest_gap_between_bounds", std::to_string(worst));
}

// Bodies that move step by step: a search that begins with the last one, and ends at a tolerance.
TEST(Separation, MayBeginWithTheLastSearch) {
  Random random;
  constexpr double tolerance = 1e-10;
  int apart = 0, near = 0;
  for_random_pairs(random, 30, [&](const Shape& a, const Shape& b) {
    Shape moving = a;
    SearchStart start;
    for (int step = 0; step < 5; ++step) {
      const double size = step == 3 ? 1 : 1e-3;  // once, it jumps
      moving.pose = moving.pose * make_pose(random.vector(size), random.rotation(size));
      const ConvexBody first = convex_body(moving), second = convex_body(b);
      const Vector3 guess = second.centre - first.centre;
      const Separation exact = separation(first, second, guess);
      const Separation found = separation(first, second, guess, tolerance, &start);
      const double rounding = 1e-13 * (first.bound + std::min(second.bound, 1e3) + guess.norm());
      ASSERT_LE(found.lower, exact.upper) << described(a, b);
      ASSERT_GE(found.upper + rounding, exact.lower) << described(a, b);
      EXPECT_LE(testing::distance_outside(moving, found.points.on_a, random), 10 * rounding)
          << described(a, b);
      EXPECT_LE(testing::distance_outside(b, found.points.on_b, random), 10 * rounding)
          << described(a, b);
      if (exact.lower <= 0) continue;
      ++apart;
      near += exact.lower - found.lower <= 2 * tolerance + rounding;
      EXPECT_LE(exact.lower - found.lower, 1e-6) << described(a, b);
    }
  });
  EXPECT_GT(near, 0.999 * apart);
}

// The points of a search are not rounded again in each of the next ones.
TEST(Separation, OfManySearchesInARowStaysABound) {
  Random random;
  const Vector3 away(0.4, 0.1, 0);
  for (int kind = 0; kind < testing::shape_kinds; ++kind) {
    Shape moving = testing::random_shape(random, testing::place_of<ConvexHull>(), 0.2, 0.01);
    if (kind == testing::place_of<HalfSpace>()) continue;
    Shape still = testing::random_shape(random, kind, 0.2, 0.01);
    still.pose.translation() += away;
    const Pose start = moving.pose;
    SearchStart last;
    for (int step = 0; step < testing::cases(60'000); ++step) {
      const double angle = 1e-3 * step;
      moving.pose = make_pose(0.05 * Vector3(std::cos(angle), std::sin(angle), 0)) * start *
                    make_pose(Vector3::Zero(), so3_exp(Vector3(0.1 * std::sin(angle), 0, angle)));
      const ConvexBody first = convex_body(moving), second = convex_body(still);
      const Separation found = separation(first, second, away, 1e-10, &last);
      ASSERT_LE(found.lower, found.upper) << described(moving, still) << step;
      if (step % 100 != 99) continue;
      const Separation exact = separation(first, second, away);
      ASSERT_GE(found.upper, exact.lower) << described(moving, still) << step;
      ASSERT_LE(found.lower, exact.upper) << described(moving, still) << step;
      EXPECT_LE(exact.lower - found.lower, 2e-10) << described(moving, still) << step;
    }
  }
}

TEST(Separation, AgreesWithAlternatingProjections) {
  Random random;
  for_random_pairs(random, 20, [&](const Shape& a, const Shape& b) {
    if (testing::is_hull(a) || testing::is_hull(b)) return;
    const ConvexBody first = convex_body(a), second = convex_body(b);
    const Separation found = separation(first, second, second.origin - first.origin);
    EXPECT_LE(found.lower, testing::alternating_distance(a, b) + 1e-14) << described(a, b);
  });
}

/// The vertices of a box, as a hull.
Shape hull_of(const Shape& box) {
  const Vector3 half = std::get<Box>(box.body).size / 2;
  ConvexHull hull;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 signs((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
    hull.vertices.push_back(half.cwiseProduct(signs));
  }
  return {hull, box.pose, box.padding};
}

TEST(Separation, OfAHullOfABoxIsTheBoxes) {
  Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const Shape box = testing::random_shape(random, 2, 1, 2);
    const Shape other =
        testing::random_shape(random, random.integer(0, testing::shape_kinds - 1), 1, 2);
    const ConvexBody second = convex_body(other);
    const Shape hull = hull_of(box);
    const Separation a = separation(convex_body(box), second);
    const Separation b = separation(convex_body(hull), second);
    if (a.lower > 0) {
      EXPECT_NEAR(a.lower, b.lower, 1e-8) << kind_name(other);
    }
    EXPECT_LE(a.lower, b.upper);
    EXPECT_LE(b.lower, a.upper);
  }
}

TEST(Separation, DoesNotDependOnTheFrame) {
  Random random;
  for_random_pairs(random, 30, [&](Shape a, Shape b) {
    const Separation here = separation(convex_body(a), convex_body(b));
    const Pose pose = random.pose(3);
    a.pose = pose * a.pose;
    b.pose = pose * b.pose;
    const Separation there = separation(convex_body(a), convex_body(b));
    EXPECT_LE(here.lower, there.upper) << described(a, b);
    EXPECT_LE(there.lower, here.upper) << described(a, b);
  });
}

TEST(Separation, GivesATranslationThatSeparatesOverlappingBodies) {
  Random random;
  for_random_pairs(random, 30, [&](const Shape& a, Shape b) {
    const Separation found = separation(convex_body(a), convex_body(b));
    if (found.lower >= 0) return;
    b.pose.translation() += (1e-9 - found.lower) * found.points.direction;
    EXPECT_GT(separation(convex_body(a), convex_body(b)).lower, -1e-6) << described(a, b);
  });
}

TEST(Separation, KnowsDistancesThatAreKnown) {
  const auto sphere = [](double x, double radius) {
    return Shape{Sphere{radius}, make_pose({x, 0, 0})};
  };
  const Shape unit_box{Box{{1, 1, 1}}};
  const auto lower = [](const Shape& a, const Shape& b) {
    return separation(convex_body(a), convex_body(b)).lower;
  };
  EXPECT_NEAR(lower(sphere(0, 1), sphere(3, 0.5)), 1.5, 1e-13);
  EXPECT_NEAR(lower(sphere(2, 0.5), unit_box), 1, 1e-13);
  EXPECT_NEAR(lower({Box{{1, 1, 1}}, make_pose({5, 0, 0})}, unit_box), 4, 1e-13);
  EXPECT_NEAR(lower({Box{{1, 1, 1}}, make_pose({2, 2, 0})}, unit_box), std::sqrt(2), 1e-13);
  EXPECT_NEAR(lower({Capsule{0.1, 2}, make_pose({1, 0, 0})}, {Capsule{0.1, 2}}), 0.8, 1e-13);
  EXPECT_NEAR(lower({Cylinder{1, 2}, make_pose({0, 0, 3})}, {HalfSpace{}}), 2, 1e-13);
  EXPECT_NEAR(lower({Cylinder{1, 2}, make_pose({3, 0, 0})}, {Cylinder{0.5, 1}}), 1.5, 1e-12);
}

TEST(Separation, OfBodiesFarAwayIncludesRounding) {
  // At 1e5 m the positions have eleven digits behind the point.
  const Shape a{Sphere{0.1}, make_pose({1e5, 1e5, 0})};
  const Shape b{Sphere{0.1}, make_pose({1e5 + 0.2, 1e5, 0})};
  const Separation touching = separation(convex_body(a), convex_body(b));
  EXPECT_LE(touching.lower, 0);
  EXPECT_GE(touching.upper, 0);
  EXPECT_LE(touching.upper - touching.lower, 1e-8);
}

}  // namespace
}  // namespace beeline
