#include <gtest/gtest.h>
#include <iterator>

#include <beeline/collision/scene.h>

#include <tests/collision/random_shape.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

TEST(Shape, AcceptsEveryKindAndNamesIt) {
  Random random;
  const char* names[] = {"sphere", "capsule", "box", "cylinder", "half_space", "convex_hull"};
  static_assert(std::size(names) == testing::shape_kinds);
  for (int kind = 0; kind < testing::shape_kinds; ++kind) {
    const Shape shape = testing::random_shape(random, kind, 1, 1);
    EXPECT_NO_THROW(check_shape(shape));
    EXPECT_EQ(kind_name(shape), names[kind]);
  }
  EXPECT_NO_THROW(check_shape({.body = Box{{0, 0, 0}}})) << "a point";
}

TEST(Shape, RefusesNumbersThatAreNoLengths) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(check_shape({.body = Sphere{-0.1}}), "a sphere has a radius of -0.1 m");
  EXPECT_REFUSED(check_shape({.body = Sphere{nan}}), "radius");
  EXPECT_REFUSED(check_shape({.body = Capsule{0.1, 2e6}}), "a capsule has a length of 2e+06 m");
  EXPECT_REFUSED(check_shape({.body = Box{{1, -1, 1}}}), "a box has an edge of -1 m");
  EXPECT_REFUSED(check_shape({.body = Cylinder{nan, 1}}), "a cylinder has a radius");
  EXPECT_REFUSED(check_shape({.body = ConvexHull{}}), "a convex hull has no vertices");
  EXPECT_REFUSED(check_shape({.body = ConvexHull{{{0, nan, 0}}}}), "coordinate");
  EXPECT_REFUSED(check_shape({.padding = -1}), "padding");
  Shape stretched;
  stretched.pose.linear() *= 2;
  EXPECT_REFUSED(check_shape(stretched), "the pose of a sphere");
}

}  // namespace
}  // namespace beeline
