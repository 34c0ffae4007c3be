#include <gtest/gtest.h>

#include <beeline/collision/internal/box_gaps.h>
#include <beeline/collision/internal/separation.h>
#include <beeline/collision/internal/tube_gap.h>

#include <tests/collision/random_shape.h>
#include <tests/random_arm.h>

namespace beeline {

using namespace internal;

namespace {

using testing::Random;

int random_kind(Random& random) {
  const int kind = random.integer(0, testing::shape_kinds - 1);
  return kind == testing::place_of<HalfSpace>() ? testing::place_of<ConvexHull>() : kind;
}

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
      shapes.push_back(testing::random_shape(random, random_kind(random), size, 3 * size));
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

/// The lanes compute what highest_along() computes, and both bound the motion of all points.
TEST(MovingCapsule, IsBoundedOverTheTube) {
  Random random;
  for (int i = 0; i < testing::cases(1500); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), 4);
    const std::size_t last = arm.joints().size();
    const Shape shape = testing::random_shape(random, random_kind(random), 0.5, 0.5);
    const ConvexBody body = convex_body(shape);
    ChainMotion motion(arm);
    const Configuration none = Configuration::Zero(arm.dof());
    const Configuration middle = random.configuration(arm);
    const double size = std::pow(10, random.uniform(-4, 0));
    const auto any = [&] { return random.uniform(-size, size); };
    const Configuration half = Configuration::NullaryExpr(arm.dof(), any);
    const JointReach reach = motion.reach(body, last, Configuration::Constant(arm.dof(), -4),
                                          Configuration::Constant(arm.dof(), 4));
    motion.set({middle, half, none});
    const ChainMotion::Frame& frame = motion.frame(last);
    const MovingCapsule capsule =
        carried_by(frame, capsule_around(body), motion.bounds(reach, last, 0));
    const auto body_at = [&](double s) {
      ChainMotion still(arm);
      still.set({middle + s * half, none, none});
      return in_world(still, {body, last});
    };
    const Vector3 n = random.direction();
    std::vector<BoxRow> boxes(3);
    for (BoxRow& box : boxes) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.centre[k] = random.uniform(-5, 5);
        box.half[k] = random.integer(0, 2) * random.uniform(0, 1);
      }
    }
    const std::uint32_t indices[] = {2, 0, 1};
    std::array<double, boxes_at_once> gaps;
    box_gaps(capsule, boxes, indices, gaps);
    for (int k = -4; k <= 4; ++k) {
      const ConvexBody at = body_at(k / 4.0);
      EXPECT_LE(support(at, n), highest_along(capsule, n) + 1e-12);
      for (std::size_t j = 0; j < 3; ++j) {
        const BoxRow& box = boxes[indices[j]];
        Shape obstacle{Box{2 * Vector3(box.half[0], box.half[1], box.half[2])}};
        obstacle.pose = make_pose({box.centre[0], box.centre[1], box.centre[2]});
        EXPECT_LE(gaps[j], separation(at, convex_body(obstacle)).upper + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace beeline
