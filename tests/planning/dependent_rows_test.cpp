#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/random.h>

namespace beeline {
namespace {

using testing::Random;

// Several times what the longest of these searches needs; a search that does not end exceeds it.
constexpr std::int64_t enough_work = 1'000'000;

Arm planar_chain(Random& random, int count) {
  std::vector<Joint> joints;
  for (int i = 0; i < count; ++i) {
    Joint joint;
    joint.name = "j" + std::to_string(i);
    joint.offset = to_space(Pose2{i == 0 ? 0.0 : random.uniform(0.3, 1), 0, 0}, 0);
    joint.screw = rotation_screw(Vector3::UnitZ());
    joints.push_back(joint);
  }
  return {"planar", joints, to_space(Pose2{0.4, 0, 0}, 0)};
}

/// Configurations with bent elbows.
Configuration bent_elbows(Random& random, const Arm& arm) {
  Configuration q(arm.dof());
  for (double& value : q) {
    value = (random.integer(0, 1) == 0 ? -1 : 1) * random.uniform(0.5, 1.2);
  }
  return q;
}

Task task_of_mask(int bits) {
  Task task;
  for (std::size_t i = 0; i < 6; ++i) task.rows[i] = (bits >> i & 1) != 0;
  return task;
}

/// The rows of a task in which a planar arm moves its tool.
Task rows_in_plane(Task task) {
  for (std::size_t i = 0; i < 6; ++i) task.rows[i] = task.rows[i] && Task::planar().rows[i];
  return task;
}

PathMotion line_motion(const Arm& arm, const std::optional<Configuration>& start, const Pose& a,
                       const Pose& b, const Task& task) {
  const std::vector<Pose> poses{a, b};
  return move_along(arm, start, route_of(lines_through(poses), PathKind::line),
                    {.task = task, .budget = {.max_work = enough_work}});
}

class DependentRows : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Joints, DependentRows, ::testing::Values(2, 3, 4, 5));

// A row that a planar arm does not move changes nothing on a line in its plane.
TEST_P(DependentRows, DoNotMatterInThePlane) {
  Random random;
  for (int i = 0; i < testing::cases(6); ++i) {
    const Arm arm = planar_chain(random, GetParam());
    const Configuration q = bent_elbows(random, arm);
    Configuration moved = q;
    for (double& value : moved) value += random.uniform(-0.1, 0.1);
    const Pose a = forward_kinematics(arm, q), b = forward_kinematics(arm, moved);
    for (int bits = 1; bits < 64; ++bits) {
      const Task task = task_of_mask(bits), rows = rows_in_plane(task);
      if (rows == task) continue;
      for (const bool given : {false, true}) {
        const auto start = given ? std::optional(q) : std::nullopt;
        const PathMotion motion = line_motion(arm, start, a, b, task);
        const MotionStatus expected =
            rows.size() == 0 ? MotionStatus::reached : line_motion(arm, start, a, b, rows).status;
        // With free rotations the bound of the rotation about a row is larger than the rotation.
        const bool partly = task.orientations() % 3 != 0;
        if (partly && motion.status == MotionStatus::not_proved) continue;
        ASSERT_EQ(motion.status, expected) << task << ", " << given << ": " << motion.reason;
      }
    }
  }
}

// A line that leaves the plane is refused.
TEST_P(DependentRows, AreRefusedOffThePlane) {
  Random random;
  const Arm arm = planar_chain(random, GetParam());
  const Configuration q = bent_elbows(random, arm);
  const Pose a = forward_kinematics(arm, q);
  Pose b = a;
  b.translation().z() += 0.1;
  for (int bits = 1; bits < 64; ++bits) {
    const Task task = task_of_mask(bits);
    if (!task.rows[2]) continue;
    for (const bool given : {false, true}) {
      const PathMotion motion =
          line_motion(arm, given ? std::optional(q) : std::nullopt, a, b, task);
      ASSERT_EQ(motion.status, MotionStatus::unreachable) << task << ", " << given;
      ASSERT_EQ(motion.reason.code, ReasonCode::path_leaves_workspace) << task << ", " << given;
    }
  }
}

TEST(DependentRowsOfBranches, AreMeasuredByTheOthers) {
  const Arm arm = built_in("rrr");
  const Configuration q = (Configuration(3) << 0.3, 1.1, -0.7).finished();
  Configuration moved = q;
  moved.array() += 0.1;
  const std::vector<Pose> poses{forward_kinematics(arm, q), forward_kinematics(arm, moved)};
  const ToolPath path = lines_through(poses);
  const Branch planar = plan_path(arm, q, path, {.task = Task::planar()});
  const Branch spatial = plan_path(arm, q, path, {.task = Task::spatial()});
  ASSERT_TRUE(planar && spatial);
  EXPECT_GT(spatial.inverse_condition, 0.01);
  EXPECT_NEAR(spatial.inverse_condition, planar.inverse_condition, 1e-3);
  const auto map = branch_map(arm, path, {.task = task_of_mask(0b000111)});
  EXPECT_FALSE(map.empty());
  EXPECT_LT(map.size(), 30U);
}

}  // namespace
}  // namespace beeline
