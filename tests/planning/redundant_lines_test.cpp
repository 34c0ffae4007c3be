#include <beeline/certificate/verify.h>

#include <tests/planning/motion_promises.h>

namespace beeline {
namespace {

using namespace testing;

class RedundantLines : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, RedundantLines, ::testing::Values("panda", "iiwa14"),
                         [](const auto& arm) { return std::string(arm.param); });

std::vector<Pose> random_poses(Random& random, const Pose& first) {
  std::vector<Pose> poses{first};
  for (int left = random.integer(1, 4); left > 0; --left) {
    Pose next = poses.back();
    next.translation() += random.direction() * random.uniform(0.05, 0.5);
    next.linear() = so3_exp(random.direction() * random.uniform(0, 1.2)) * next.linear();
    poses.push_back(next);
  }
  return poses;
}

// A motion from a given configuration shows that the lines are feasible, so without it one is found
// too, and both are proved.
TEST_P(RedundantLines, AreFoundWithoutTheStart) {
  const Arm arm = built_in(GetParam());
  Random random;
  int feasible = 0;
  for (int i = 0; i < cases(40); ++i) {
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> poses = random_poses(random, forward_kinematics(arm, q));
    const PathMotion given = move_in_lines(arm, q, std::span(poses).subspan(1));
    if (!given) continue;
    ++feasible;
    EXPECT_FALSE(verify(arm, given.trajectory, poses).reason);
    const PathMotion found = move_in_lines(arm, poses);
    ASSERT_EQ(found.status, MotionStatus::reached) << found.reason;
    EXPECT_FALSE(verify(arm, found.trajectory, poses).reason);
  }
  EXPECT_GE(feasible, cases(40) / 8);
}

// The knots keep the margin to the limits that the header states, if a motion with it is known.
TEST_P(RedundantLines, KeepAMarginThatIsPossible) {
  const Arm arm = built_in(GetParam());
  Random random;
  for (int i = 0; i < cases(40); ++i) {
    const Configuration q = inner_configuration(random, arm);
    const std::vector<Pose> poses = random_poses(random, forward_kinematics(arm, q));
    const ToolPath path = lines_through(poses);
    const BranchOptions options{.task = Task::spatial()};
    const Branch given = plan_path(arm, q, path, options);
    if (!given) continue;
    const Branch best = plan_path(arm, {}, path, options);
    ASSERT_TRUE(best) << best.reason;
    EXPECT_GE(best.limit_margin, 0.7 * std::min(given.limit_margin, 0.25));
  }
}

// Poses given twice, also the first one, change neither the layers of the graph nor the outcome.
TEST_P(RedundantLines, StandStillAtRepeatedPoses) {
  const Arm arm = built_in(GetParam());
  Random random;
  for (int i = 0; i < cases(40); ++i) {
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> poses = random_poses(random, forward_kinematics(arm, q));
    std::vector<Pose> repeated;
    for (const Pose& pose : poses) repeated.insert(repeated.end(), {pose, pose});
    const BranchOptions options{.task = Task::spatial()};
    const Branch once = plan_path(arm, q, lines_through(poses), options);
    const Branch twice = plan_path(arm, q, lines_through(repeated), options);
    ASSERT_EQ(twice.status, once.status) << once.reason << twice.reason;
    if (!once) continue;
    EXPECT_NEAR(twice.limit_margin, once.limit_margin, 1e-6);
  }
}

// What is suggested works, with the same options and to the same proof.
TEST_P(RedundantLines, SuggestionsWork) {
  const Arm arm = built_in(GetParam());
  Random random;
  int suggested = 0;
  const PathMotionOptions options{.tolerance = 2e-5,
                                  .profile = Profile::trapezoidal,
                                  .interpolation = Interpolation::cubic,
                                  .suggest = true};
  for (int i = 0; i < cases(12); ++i) {
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> poses = random_poses(random, forward_kinematics(arm, q));
    const std::optional<Configuration> start = i % 2 == 0 ? std::optional(q) : std::nullopt;
    const Route route = route_of(lines_through(poses), PathKind::line);
    const PathMotion refused = move_along(arm, start, route, options);
    if (refused) continue;
    for (const NearbyPath& nearby : refused.nearby) {
      ++suggested;
      const Route moved = route_of(nearby.path, PathKind::line);
      const PathMotion motion =
          move_along(arm, nearby.start ? nearby.start : start, moved, options);
      ASSERT_EQ(motion.status, MotionStatus::reached) << nearby.description << motion.reason;
      EXPECT_LE(motion.deviation.bound.position, options.tolerance);
      EXPECT_EQ(motion.trajectory.interpolation(), Interpolation::cubic);
    }
  }
  EXPECT_GE(suggested, cases(12) / 6);
}

}  // namespace
}  // namespace beeline
