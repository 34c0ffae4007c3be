#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/certificate/internal/line_step.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>
#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline::internal {
namespace {

using std::numbers::pi;

Pose moved_by(const Pose& pose, const Vector3& way, const Vector3& turn) {
  return make_pose(pose.translation() + way, so3_exp(turn) * pose.linear());
}

/// A line of any kind in the neighbourhood of two poses.
Line random_line(testing::Random& random, const Pose& a, const Pose& b) {
  const Vector3 way = b.translation() - a.translation();
  switch (random.integer(0, 6)) {
    case 0:
      return {a, b};
    case 1:
      return {interpolate(a, b, -1), interpolate(a, b, 2)};  // longer than the step
    case 2:
      return {interpolate(a, b, 0.3), interpolate(a, b, 0.6)};  // ends within the step
    case 3:
      return {a, moved_by(a, Vector3::Zero(), random.vector())};  // rotation only
    case 4:
      return {a, moved_by(a, random.vector(1e-3), random.vector())};
    case 5:
      return {a, a};
    default:
      return {moved_by(a, random.vector(0.1), random.vector(0.1)),
              moved_by(b, 2 * way + random.vector(0.1), random.vector(0.5))};
  }
}

const std::vector<std::string> tasks = {"spatial",     "position",    "planar",      "111110:tool",
                                        "001000",      "110001",      "000111",      "000001",
                                        "110111:tool", "001000:tool", "111001",      "111110",
                                        "100100:tool", "000110",      "110110:tool", "101011:tool"};

void expect_step_bound(testing::Random& random, const Arm& arm, const Task& task) {
  const double size = std::pow(10, random.uniform(-3, 0));
  const Configuration q_a = random.configuration(arm);
  Configuration q_b = q_a;
  for (double& value : q_b) value += random.uniform(-size, size);
  const Line line = random_line(random, forward_kinematics(arm, q_a), forward_kinematics(arm, q_b));
  const auto measured = [&](double t) {
    return internal::deviation_from(line, forward_kinematics(arm, q_a + t * (q_b - q_a)), task);
  };
  const Deviation bound = line_step_bound(arm, line, task, q_a, q_b, measured(0), measured(1));
  for (int i = 0; i <= 20; ++i) {
    const Deviation seen = measured(i / 20.0);
    // A thousand times the rounding error, because log's derivative or a search magnifies it.
    ASSERT_LE(seen.position, bound.position + 1e-9)
        << name(task) << " step " << size << " at " << i;
    ASSERT_LE(seen.orientation, bound.orientation + 1e-9)
        << name(task) << " step " << size << " at " << i;
  }
}

TEST(LineStepBound, HoldsForEveryTaskOnEveryLine) {
  testing::Random random;
  for (int i = 0; i < 4000; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), random.integer(0, 3));
    expect_step_bound(random, arm, task_named(tasks[i % tasks.size()]));
  }
}

TEST(LineStepBound, HoldsForBuiltInArmsInTheirOwnTask) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 300; ++i) expect_step_bound(random, arm, default_task(arm));
  }
}

// Rotations about one axis, with the line's orientations in these rows or tilted out of them.
TEST(LineStepBound, HoldsForScarasInEveryTask) {
  testing::Random random;
  const Arm arm = built_in("scara");
  ASSERT_TRUE(arm.rotates_about_z());
  for (int i = 0; i < 1600; ++i) {
    expect_step_bound(random, arm, task_named(tasks[i % tasks.size()]));
  }
}

// On a line that is the step's own chord the bound equals the chord's, so that no more samples
// are needed.
TEST(LineStepBound, FallsWithTheSquareOfTheStep) {
  testing::Random random;
  for (const std::string name : {"rrr", "panda", "ur5", "scara"}) {
    const Arm arm = built_in(name);
    const Task task = name == "scara" ? task_named("111001") : default_task(arm);
    for (int i = 0; i < 50; ++i) {
      const Configuration q = random.configuration(arm);
      Configuration way(arm.dof());
      for (double& part : way) part = random.uniform(-1, 1);
      const auto bound_of = [&](double step) {
        const Configuration q_b = q + step * way;
        const Pose from = forward_kinematics(arm, q), to = forward_kinematics(arm, q_b);
        return line_step_bound(arm, {from, to}, task, q, q_b, {}, {});
      };
      const Deviation large = bound_of(1e-2), small = bound_of(1e-3);
      ASSERT_LE(small.position, 0.012 * large.position) << name;
      if (large.orientation > 0) {
        ASSERT_LE(small.orientation, 0.02 * large.orientation) << name;
      }
    }
  }
}

TEST(DeviationFrom, IsNothingOnTheLine) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose a = random.pose(), b = random.pose();
    const Line line = random_line(random, a, b);
    const double s = random.uniform(0, 1);
    const Task task = task_named(tasks[i % tasks.size()]);
    const Deviation on = internal::deviation_from(line, interpolate(line.from, line.to, s), task);
    ASSERT_LT(on.position, 1e-9) << name(task);
    ASSERT_LT(on.orientation, 1e-9) << name(task);
  }
}

TEST(DeviationFrom, IsTheDistanceToTheSegment) {
  const Line line{make_pose({1, 0, 0}), make_pose({3, 0, 0})};
  const auto position = [&](const Vector3& p) {
    return internal::deviation_from(line, make_pose(p), Task::spatial()).position;
  };
  EXPECT_NEAR(position({2, 0.5, 0}), 0.5, 1e-15);
  EXPECT_NEAR(position({2, 3, 4}), 5, 1e-15);
  EXPECT_NEAR(position({0, 0, 0}), 1, 1e-15) << "before the line's beginning";
  EXPECT_NEAR(position({6, 4, 0}), 5, 1e-15) << "behind its end";
}

TEST(DeviationFrom, ComparesTheOrientationAtTheNearestPoint) {
  const Line line{make_pose({0, 0, 0}), make_pose({2, 0, 0}, so3_exp({0, 0, 1}))};
  for (const double s : {0.0, 0.25, 0.7, 1.0}) {
    const Pose pose = make_pose({2 * s, 1, 0}, so3_exp({0, 0, s + 0.1}));
    EXPECT_NEAR(internal::deviation_from(line, pose, Task::spatial()).orientation, 0.1, 1e-14);
  }
}

TEST(DeviationFrom, CountsOnlyTheRowsOfTheTask) {
  const Line line{make_pose({0, 0, 0}), make_pose({1, 0, 0})};
  const Pose pose = make_pose({0.5, 3, 4}, so3_exp({0.1, 0, 0.2}));
  EXPECT_NEAR(internal::deviation_from(line, pose, task_named("110001")).position, 3, 1e-15);
  EXPECT_NEAR(internal::deviation_from(line, pose, task_named("110001")).orientation, 0.2, 1e-12);
  EXPECT_NEAR(internal::deviation_from(line, pose, Task::position()).orientation, 0, 0);
  EXPECT_NEAR(internal::deviation_from(line, pose, task_named("000111")).position, 0, 0);
}

// On a line without translation the orientation determines the nearest point, also for a rotation
// by pi, for which both directions are equivalent.
TEST(DeviationFrom, IsTheAngleToTheArcForALineWithoutTranslation) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const double angle = i % 4 == 0 ? pi : random.uniform(0.01, pi);
    const Vector3 axis = random.direction();
    const Pose from = random.pose();
    const Line line{from, moved_by(from, Vector3::Zero(), angle * axis)};
    // At exactly pi either direction may be the line's own.
    const Vector3 turn = pose_difference(line.to, line.from).tail<3>();
    ASSERT_NEAR(turn.norm(), angle, 1e-7);
    const Vector3 across = turn.unitOrthogonal();
    const double s = random.uniform(0, 1), off = random.uniform(0, 0.2);
    const Pose at = interpolate(line.from, line.to, s);
    const Pose beside = moved_by(at, Vector3::Zero(), off * (so3_exp(s * turn) * across));
    const double seen = internal::deviation_from(line, beside, Task::spatial()).orientation;
    ASSERT_LE(seen, off + 1e-9);
    ASSERT_GE(seen, off * 0.6) << "a swing away leads off the arc";
    const Pose beyond = moved_by(line.to, Vector3::Zero(), 0.1 * turn.normalized());
    ASSERT_NEAR(internal::deviation_from(line, beyond, Task::spatial()).orientation, 0.1, 1e-7);
  }
}

TEST(DeviationFrom, IsTheMinimumOverTheArc) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Pose from = random.pose();
    const Line line{from, moved_by(from, Vector3::Zero(), random.rotation().col(0) * 2)};
    const Pose pose = make_pose(from.translation(), random.rotation());
    const Task task = task_named(i % 2 == 0 ? "spatial" : "111110:tool");
    double least = pi;
    for (int k = 0; k <= 1000; ++k) {
      const Pose at = interpolate(line.from, line.to, k / 1000.0);
      least = std::min(least, task_deviation(task, at, pose).orientation);
    }
    ASSERT_NEAR(internal::deviation_from(line, pose, task).orientation, least, 2e-3) << name(task);
  }
}

}  // namespace
}  // namespace beeline::internal
