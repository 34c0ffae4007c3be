#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

#include <tests/random.h>

namespace beeline {
namespace {

/// A configuration whose joints are at least 0.3 inside their limits, where these allow it.
Configuration inside(testing::Random& random, const Arm& arm) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const double lower = std::max(limits.lower, -3.0) + 0.3;
    const double upper = std::min(limits.upper, 3.0) - 0.3;
    q[k] = lower < upper ? random.uniform(lower, upper) : (limits.lower + limits.upper) / 2;
  }
  return q;
}

/// A seed near a solution keeps an arm there: an answer on another branch moves the joints far.
TEST(NearSeed, KeepsRedundantArmsNear) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa7", "gen3", "RRRR:0.4,0.3,0.2,0.1", "ur5e"}) {
    const Arm arm = read_arm(name);
    int far = 0;
    const int count = testing::cases(1500);
    for (int i = 0; i < count; ++i) {
      const Configuration q = inside(random, arm);
      Configuration seed = q;
      for (double& value : seed) value += random.uniform(-0.05, 0.05);
      const Pose pose = forward_kinematics(arm, q);
      const InverseResult found = inverse_kinematics(arm, pose, {.seed = seed});
      ASSERT_EQ(found.status, InverseStatus::solved) << name << ": " << q.transpose();
      const Configuration& solution = found.solutions.front();
      EXPECT_TRUE(forward_kinematics(arm, solution).isApprox(pose, 1e-9));
      far += (solution - seed).lpNorm<Eigen::Infinity>() > 1 ? 1 : 0;
    }
    // Next to a singularity a small motion of the tool may need a large one of the joints.
    EXPECT_LE(far, count / 100) << name;
  }
}

/// Poses 5 mm from the seed's. Where a near solution exists, it is found: no jump to another one.
TEST(NearSeed, PosesFiveMillimetresApartDoNotJump) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa14", "gen3", "xarm7", "rm75"}) {
    const Arm arm = read_arm(name);
    int near = 0, jumps = 0, longer = 0;
    for (int i = 0; i < testing::cases(1500); ++i) {
      const Configuration seed = random.configuration(arm);
      Pose pose = forward_kinematics(arm, seed);
      pose.translation() += 0.005 * random.direction();
      const auto nearest =
          inverse_kinematics(arm, pose, {.seed = seed, .redundancy = Redundancy::nearest});
      if (!nearest) continue;
      const double least = (nearest.solutions.front() - seed).norm();
      if (least > 0.1) continue;
      ++near;
      const InverseResult found = inverse_kinematics(arm, pose, {.seed = seed});
      ASSERT_EQ(found.status, InverseStatus::solved) << name << ": " << seed.transpose();
      const Configuration& q = found.solutions.front();
      EXPECT_TRUE(limit_violations(arm, q).empty()) << name << ": " << q.transpose();
      EXPECT_TRUE(forward_kinematics(arm, q).isApprox(pose, 1e-9)) << name;
      const double distance = (q - seed).norm();
      jumps += distance > 0.3;
      longer += distance > 1.001 * least;
    }
    EXPECT_GE(near, testing::cases(1000)) << name;
    EXPECT_EQ(jumps, 0) << name;
    EXPECT_LE(longer, near / 100) << name;
  }
}

/// The same with weights: the distance is the weighted one.
TEST(NearSeed, MinimisesTheWeightedDistance) {
  testing::Random random;
  for (const char* name : {"panda", "gen3"}) {
    const Arm arm = read_arm(name);
    int longer = 0;
    const int count = testing::cases(300);
    for (int i = 0; i < count; ++i) {
      const Configuration seed = inside(random, arm);
      Eigen::VectorXd weights(arm.dof());
      for (double& weight : weights) weight = random.uniform(0.2, 5);
      Pose pose = forward_kinematics(arm, seed);
      pose.translation() += 0.005 * random.direction();
      const auto distance = [&](std::optional<Redundancy> redundancy) {
        const InverseResult found = inverse_kinematics(
            arm, pose, {.seed = seed, .redundancy = redundancy, .weights = weights});
        if (!found) return 0.0;
        return std::sqrt(weights.dot((found.solutions.front() - seed).cwiseAbs2()));
      };
      longer += distance({}) > 1.001 * distance(Redundancy::nearest);
    }
    EXPECT_LE(longer, 2 + count / 50) << name;
  }
}

/// Without a seed, and with another method, the default remains `any`.
TEST(NearSeed, IsTheDefaultWithASeedOnly) {
  testing::Random random;
  const Arm arm = read_arm("panda");
  int other = 0;
  for (int i = 0; i < 50; ++i) {
    const Configuration seed = inside(random, arm);
    Pose pose = forward_kinematics(arm, seed);
    pose.translation() += 0.005 * random.direction();
    const auto solutions = [&](const InverseOptions& with) {
      return inverse_kinematics(arm, pose, with).solutions;
    };
    const auto without = solutions({});
    EXPECT_EQ(without, solutions({.redundancy = Redundancy::any}));
    const auto any = solutions({.seed = seed, .redundancy = Redundancy::any});
    other += any != solutions({.seed = seed});
    const InverseMethod numerical = InverseMethod::numerical;
    EXPECT_EQ(solutions({.seed = seed, .method = numerical}),
              solutions({.seed = seed, .method = numerical, .redundancy = Redundancy::any}));
  }
  EXPECT_GT(other, 25);
}

/// A seed that solves the pose is the solution.
TEST(NearSeed, ThatSolvesIsTheSolution) {
  testing::Random random;
  const Arm arm = read_arm("iiwa14");
  for (int i = 0; i < 100; ++i) {
    const Configuration seed = random.configuration(arm);
    const auto found = inverse_kinematics(arm, forward_kinematics(arm, seed), {.seed = seed});
    ASSERT_EQ(found.status, InverseStatus::solved);
    EXPECT_EQ(found.solutions.front(), seed);
  }
}

}  // namespace
}  // namespace beeline
