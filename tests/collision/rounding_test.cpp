#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/separation.h>
#include <beeline/kinematics/forward.h>

#include <tests/collision/random_shape.h>
#include <tests/collision/wide.h>
#include <tests/random_arm.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;
using testing::Wide;
using testing::WidePose;
using testing::WideVector;

/// The distance that a direction proves, and its sign may be negative.
Wide proved_along(const Shape& a, const WidePose& frame_a, const Shape& b, const WidePose& frame_b,
                  const Vector3& direction) {
  const WideVector n = direction.cast<Wide>();
  return (-testing::wide_support(b, frame_b, -n) - testing::wide_support(a, frame_a, n)) /
         std::sqrt(n.squaredNorm());
}

TEST(SeparationRounding, IsOutwardsAtAllOffsetsAndSizes) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  for (int i = 0; i < testing::cases(60'000); ++i) {
    const double size = std::pow(10, random.uniform(-6, 1));
    const double offset = random.integer(0, 1) == 0 ? 0 : std::pow(10, random.uniform(0, 5));
    int first = random.integer(0, testing::shape_kinds - 1);
    if (first == testing::place_of<HalfSpace>()) first = 0;
    const int second = random.integer(0, testing::shape_kinds - 1);
    Shape a = testing::random_shape(random, first, size, 3 * size);
    Shape b = testing::random_shape(random, second, size, 3 * size);
    const Vector3 moved = offset * random.direction();
    a.pose.translation() += moved;
    b.pose.translation() += moved;
    for (Shape* shape : {&a, &b}) {
      if (random.integer(0, 1) == 0) testing::move_vertices(*shape, offset * random.direction());
    }
    const Separation found = separation(convex_body(a), convex_body(b));
    const std::string what = kind_name(a) + " and " + kind_name(b) + " of " + number(size) +
                             " m at " + number(offset) + " m, case " + std::to_string(i);
    // A half-space has a finite support only for its own normal, which is in the bound as it is.
    if (second != testing::place_of<HalfSpace>()) {
      EXPECT_LE(Wide(found.lower), proved_along(a, {}, b, {}, found.points.direction)) << what;
    }
    const WideVector between = (found.points.on_a - found.points.on_b).cast<Wide>();
    EXPECT_GE(Wide(found.upper), std::sqrt(between.squaredNorm())) << what;
  }
}

/// The bounds of a model, whose bodies are moved by its own forward kinematics.
TEST(SeparationRounding, OfANearestPairIncludesTheKinematics) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  for (int i = 0; i < testing::cases(6'000); ++i) {
    const double offset = random.integer(0, 1) == 0 ? 0 : std::pow(10, random.uniform(0, 5));
    const Pose mount = make_pose(offset * random.direction(), random.rotation());
    const Arm arm = with_mount(testing::random_arm(random, random.integer(1, 7), 4), mount);
    const Configuration q = random.configuration(arm);
    const std::vector<WidePose> links = testing::wide_link_poses(arm, q);
    const std::size_t last = arm.joints().size();
    const double size = std::pow(10, random.uniform(-6, -1));
    const auto kind = [&] {
      return random.integer(0, 4) == 0 ? testing::place_of<ConvexHull>() : random.integer(0, 3);
    };
    Shape tip = testing::random_shape(random, kind(), size, 3 * size);
    Shape ball = testing::random_shape(random, kind(), size, 3 * size);
    ball.pose = link_poses(arm, q)[last] * ball.pose;
    for (Shape* shape : {&tip, &ball}) {
      if (random.integer(0, 1) == 0) testing::move_vertices(*shape, offset * random.direction());
    }
    const CollisionModel model(arm, {{"tip", last, {tip}}}, {.obstacles = {{"ball", {ball}}}});
    const BodyDistance found = nearest_pair(model, q);
    WidePose world;
    world.translation = -arm.base().translation().cast<Wide>();
    EXPECT_LE(Wide(found.lower), proved_along(tip, links[last], ball, world, found.normal))
        << number(size) << " m at " << number(offset) << " m, case " << i;
    EXPECT_LE(found.upper - (found.on_first - found.on_second).norm(), 1e-10 * (1 + offset));
  }
}

}  // namespace
}  // namespace beeline
