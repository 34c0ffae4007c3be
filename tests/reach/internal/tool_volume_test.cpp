#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>
#include <beeline/reach/internal/tool_volume.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

using internal::ToolVolume;
using testing::Random;

Limits random_range(Random& random) {
  const double lower = random.uniform(-3, 3);
  return {.lower = lower, .upper = lower + random.uniform(0, 4)};
}

/// The arm on a rail, on a mobile base, on both, or as it is.
Arm on_random_base(Random& random, Arm arm) {
  const int kind = random.integer(0, 3);
  if (kind % 2 == 1) arm = with_rail(arm, random.direction(), random_range(random));
  if (kind >= 2) {
    const Limits x = random_range(random), y = random_range(random), heading{-3, 3};
    arm = with_mobile_base(arm, {.x = x, .y = y, .heading = heading});
  }
  return arm;
}

void expect_no_tool_excluded(const Arm& arm, Random& random, int configurations) {
  const ToolVolume volume(arm);
  for (int i = 0; i < configurations; ++i) {
    const Pose tool = forward_kinematics(arm, random.configuration(arm));
    ASSERT_FALSE(volume.excludes(tool.translation(), 0)) << arm.name();
  }
}

TEST(ToolVolume, ContainsTheToolsOfBuiltInArms) {
  Random random;
  for (const std::string& name : built_in_names()) {
    for (int i = 0; i < 4; ++i) {
      expect_no_tool_excluded(on_random_base(random, built_in(name)), random, 500);
    }
  }
}

TEST(ToolVolume, ContainsTheToolsOfRandomArms) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), i % 2 == 0 ? 0 : 3);
    expect_no_tool_excluded(on_random_base(random, arm), random, 50);
  }
}

// A rail sweeps the ball of the arm on it: what is farther from the segment of its centres is
// outside, what is nearer is not. Of arms with revolute joints alone the ball may be another one.
TEST(ToolVolume, OfAnArmOnARailIsTheSweptBall) {
  Random random;
  int outside = 0, inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const Arm alone = testing::random_arm(random, 3);
    if (std::isfinite(internal::ball_of_tool(alone).radius)) continue;
    const Limits range = random_range(random);
    const Vector3 axis = random.direction();
    const ToolVolume volume(with_rail(alone, axis, range));
    const Vector3 position = random.uniform(1, 20) * random.direction();
    const Vector3 offset = position - alone.reach().centre;
    const double along = std::clamp(offset.dot(axis), range.lower, range.upper);
    const double beyond = (offset - along * axis).norm() - alone.reach().radius;
    EXPECT_EQ(volume.excludes(position, 0), beyond > 1e-9) << beyond;
    ++(beyond > 0 ? outside : inside);
  }
  EXPECT_GE(outside, 50);
  EXPECT_GE(inside, 50);
}

TEST(ToolVolume, OfAPlanarArmIgnoresTheHeight) {
  const ToolVolume volume(with_rail(built_in("rrr"), Vector3::UnitX(), {.lower = 0, .upper = 2}));
  EXPECT_FALSE(volume.excludes({10.9, 0, 5}, 0));
  EXPECT_TRUE(volume.excludes({11.1, 0, 5}, 0));
  EXPECT_TRUE(volume.excludes({-9.1, 0, 0}, 0));
  EXPECT_FALSE(volume.excludes({1, 8.9, 0}, 0));
  EXPECT_TRUE(volume.excludes({1, 9.1, 0}, 0));
}

}  // namespace
}  // namespace beeline
