#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/path/random_line.h>

namespace beeline {
namespace {

using testing::Random;

class FreeRotations : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, FreeRotations, ::testing::Values("ur5", "panda"),
                         [](const auto& arm) { return std::string(arm.param); });

// Where one or two rotations are free the tool's error is large in these rows, and its derivatives
// are not the angular velocity. A joint path that follows the tool path to second order has few
// points, so that the motion is smooth and short; without these terms it has a thousand, and the
// motion takes 20 s.
TEST_P(FreeRotations, AreFollowedByFewSamples) {
  Random random;
  const Arm arm = built_in(GetParam());
  int reached = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    Task task;
    const int row = random.integer(3, 5);
    const bool free = random.integer(0, 1) == 0;
    for (int r = 3; r < 6; ++r) task.rows[static_cast<std::size_t>(r)] = (r == row) != free;
    task.frame = random.integer(0, 1) == 0 ? Frame::base : Frame::tool;
    const Configuration q = 0.6 * testing::inner_configuration(random, arm);
    Configuration moved = q;
    for (double& value : moved) value += random.uniform(-0.2, 0.2);
    const std::vector<Pose> poses{forward_kinematics(arm, q), forward_kinematics(arm, moved)};
    const PathMotion motion =
        move_along(arm, q, route_of(lines_through(poses), PathKind::line), {.task = task});
    if (!motion || motion.inverse_condition < 0.05) continue;
    ++reached;
    EXPECT_LT(motion.trajectory.size(), 300U) << task;
    EXPECT_LT(motion.trajectory.times.back(), 2) << task;
  }
  EXPECT_GE(reached, testing::cases(60) / 4);
}

}  // namespace
}  // namespace beeline
