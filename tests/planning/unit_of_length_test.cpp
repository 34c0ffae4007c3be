#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

/// The same arm of revolute joints in another unit of length.
Arm scaled(const Arm& arm, double k) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.offset.translation() *= k;
    joint.screw.head<3>() *= k;
  }
  Pose tool = arm.tool(), base = arm.base();
  tool.translation() *= k;
  base.translation() *= k;
  return {arm.name(), joints, tool, base};
}

Pose scaled(Pose pose, double k) {
  pose.translation() *= k;
  return pose;
}

/// The largest difference of two motions at 50 equal fractions of their durations, rad.
double difference(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (int i = 0; i <= 50; ++i) {
    const auto at = [i](const Trajectory& t) { return sample(t, t.duration() * i / 50).position; };
    largest = std::max(largest, (at(a) - at(b)).lpNorm<Eigen::Infinity>());
  }
  return largest;
}

// A motion of joints does not depend on the unit of length: the redundancy is resolved by layers
// that are apart by a fraction of the arm's reach. Two choices that cost the same to rounding may
// differ.
TEST(UnitOfLength, DoesNotChangeTheMotionsOfRedundantArms) {
  testing::Random random;
  int compared = 0, equal = 0;
  for (int i = 0; i < testing::cases(36); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "panda" : "iiwa7");
    const Configuration middle = middle_configuration(arm);
    const Configuration start = middle + 0.5 * (random.configuration(arm) - middle);
    const Configuration other = random.configuration(arm) - middle;
    const Pose to = forward_kinematics(arm, Configuration(start + 0.2 * other.normalized()));
    const PathMotion metres = move_in_lines(arm, start, {to});
    if (!metres) continue;
    for (const double k : {0.01, 100.0}) {
      const PathMotion motion =
          move_in_lines(scaled(arm, k), start, {scaled(to, k)}, {.tolerance = 1e-4 * k});
      ASSERT_TRUE(motion) << motion.reason;
      EXPECT_NEAR(motion.duration() / metres.duration(), 1, 0.3) << arm.name() << " x " << k;
      ++compared;
      equal += difference(motion.trajectory, metres.trajectory) < 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GE(10 * equal, 8 * compared) << equal << " of " << compared;
  EXPECT_GT(compared, testing::cases(36));
}

// The same for a rotation in place, from a start near the limit of a joint.
TEST(UnitOfLength, DoesNotChangeRotationsInPlaceFromNearALimit) {
  testing::Random random;
  int compared = 0, equal = 0;
  for (int i = 0; i < testing::cases(24); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "panda" : "iiwa7");
    const Configuration middle = middle_configuration(arm);
    Configuration start = middle + 0.5 * (random.configuration(arm) - middle);
    const int near = random.integer(0, arm.dof() - 1);
    start[near] = std::lerp(arm.limits(near).lower, arm.limits(near).upper, 0.03);
    Pose to = forward_kinematics(arm, start);
    to.linear() = so3_exp(random.uniform(0.5, 0.9) * random.direction()) * to.linear();
    const PathMotion metres = move_in_lines(arm, start, {to});
    if (!metres) continue;
    for (const double k : {1.0 / 64, 64.0}) {
      const PathMotion motion =
          move_in_lines(scaled(arm, k), start, {scaled(to, k)}, {.tolerance = 1e-4 * k});
      ++compared;
      equal += motion && difference(motion.trajectory, metres.trajectory) < 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GE(10 * equal, 9 * compared) << equal << " of " << compared;
  EXPECT_GT(compared, testing::cases(12));
}

}  // namespace
}  // namespace beeline
