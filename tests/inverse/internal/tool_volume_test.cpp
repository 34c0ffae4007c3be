#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/inverse/internal/tool_volume.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

using internal::ToolVolume;
using testing::Random;

Limits random_range(Random& random) {
  const double lower = random.uniform(-3, 3);
  return {.lower = lower, .upper = lower + random.uniform(0, 4)};
}

Pose at(const Vector3& position) {
  Pose pose = Pose::Identity();
  pose.translation() = position;
  return pose;
}

/// A task with some rows of the position, in either frame.
Task random_task(Random& random) {
  Task task{{false, false, false, true, true, true},
            random.integer(0, 1) == 0 ? Frame::base : Frame::tool};
  for (std::size_t row = 0; row < 3; ++row) task.rows[row] = random.integer(0, 3) != 0;
  return task;
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
    const Configuration q = random.configuration(arm);
    for (const Task& task : {default_task(arm), random_task(random)}) {
      const Pose tool = forward_kinematics(arm, q), far = forward_kinematics(arm, 10 * q);
      ASSERT_FALSE(volume.excludes(tool, task, 0, /*ignore_limits=*/false)) << arm.name();
      ASSERT_FALSE(volume.excludes(tool, task, 0, /*ignore_limits=*/true)) << arm.name();
      ASSERT_FALSE(volume.excludes(far, task, 0, /*ignore_limits=*/true)) << arm.name();
    }
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
    EXPECT_EQ(volume.excludes(at(position), Task::position(), 0, false), beyond > 1e-9) << beyond;
    ++(beyond > 0 ? outside : inside);
  }
  EXPECT_GE(outside, 50);
  EXPECT_GE(inside, 50);
}

TEST(ToolVolume, OfAPlanarArmIgnoresTheHeight) {
  const ToolVolume volume(with_rail(built_in("rrr"), Vector3::UnitX(), {.lower = 0, .upper = 2}));
  const auto excludes = [&](const Vector3& position, bool ignore_limits = false) {
    return volume.excludes(at(position), Task::planar(), 0, ignore_limits);
  };
  EXPECT_FALSE(excludes({10.9, 0, 5}));
  EXPECT_TRUE(excludes({11.1, 0, 5}));
  EXPECT_TRUE(excludes({-9.1, 0, 0}));
  EXPECT_FALSE(excludes({1, 8.9, 0}));
  EXPECT_TRUE(excludes({1, 9.1, 0}));
  EXPECT_FALSE(excludes({100, 0, 0}, true));
  EXPECT_TRUE(excludes({100, 9.1, 0}, true));
}

// The projection of a volume on some axes of the world: a rail at 45 degrees to them.
TEST(ToolVolume, OfSomeRowsIsTheProjection) {
  const ToolVolume volume(with_rail(built_in("ur5"), {1, 1, 0}, {.lower = 0, .upper = 2}));
  const Task x{{true, false, false, false, false, false}};
  const Task yz{{false, true, true, false, false, false}};
  const double reach = internal::ball_of_tool(built_in("ur5")).radius, end = std::sqrt(2);
  for (const double over : {-0.01, 0.01}) {
    EXPECT_EQ(volume.excludes(at({end + reach + over, 50, 50}), x, 0, false), over > 0);
    EXPECT_EQ(volume.excludes(at({50, end + reach + over, 0}), yz, 0, false), over > 0);
    EXPECT_EQ(volume.excludes(at({-reach - over, 50, 50}), x, 0, false), over > 0);
  }
  EXPECT_FALSE(volume.excludes(at({50, 0, 0}), x, 0, true));
}

/// Whether one of some searches from random configurations, limits ignored or not, converges.
bool is_found(const Arm& arm, const Pose& pose, bool ignore_limits, Random& random) {
  using namespace internal;
  const Bounds bounds = ignore_limits ? no_bounds(arm) : bounds_of(arm);
  for (int start = 0; start < 5; ++start) {
    const Configuration q = random.configuration(arm);
    if (levenberg_marquardt(arm, pose, default_task(arm), bounds, q, {}).converged) return true;
  }
  return false;
}

// Arms with prismatic joints before all others: a pose that has a solution is never refused, and
// the searches find none of a pose that is.
TEST(ToolVolume, RefusesPosesWithoutSolutionOnly) {
  Random random;
  int refused = 0, unreachable = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Arm alone = testing::random_arm(random, random.integer(1, 6), i % 3 == 0 ? 3 : 0);
    const bool built = i % 2 == 0;
    const Arm arm = on_random_base(random, built ? built_in(i % 4 == 0 ? "ur5" : "rrr") : alone);
    Pose pose = forward_kinematics(arm, random.configuration(arm));
    const InverseStatus of_reached = inverse_kinematics(arm, pose).status;
    EXPECT_TRUE(!built || of_reached == InverseStatus::solved) << arm.name() << ": " << of_reached;
    const ToolVolume volume(arm);
    Vector3 away = random.uniform(1, 20) * random.direction();
    if (arm.planar()) away.z() = 0;
    pose.translation() += away;
    for (const bool ignore_limits : {false, true}) {
      if (!volume.excludes(pose, default_task(arm), 1e-9, ignore_limits)) continue;
      const InverseStatus status =
          inverse_kinematics(arm, pose, {.ignore_limits = ignore_limits}).status;
      EXPECT_NE(status, InverseStatus::solved) << arm.name();
      EXPECT_FALSE(is_found(arm, pose, ignore_limits, random)) << arm.name();
      ++refused;
      unreachable += status == InverseStatus::unreachable;
    }
  }
  EXPECT_GE(refused, testing::cases(60));
  EXPECT_GE(unreachable, testing::cases(30));
}

}  // namespace
}  // namespace beeline
