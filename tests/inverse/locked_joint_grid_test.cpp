#include <gtest/gtest.h>

#include <beeline/model/catalog.h>

#include <tests/inverse/answer.h>
#include <tests/random_arm.h>

// All solutions of an arm with seven joints, on the grid of its redundant joint.

namespace beeline {
namespace {

Arm seven_revolute(testing::Random& random) {
  std::vector<Joint> joints;
  for (int i = 0; i < 7; ++i) {
    joints.push_back(
        testing::random_joint(random, JointKind::revolute, "j" + std::to_string(i + 1)));
  }
  return {"general", joints, random.pose(), random.pose()};
}

/// A shoulder-elbow-wrist arm whose axes miss each other by millimetres, as in Kinova's gen3.
Arm with_small_offsets(testing::Random& random) {
  const Arm arm = built_in("iiwa14");
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.offset.translation() += 0.005 * random.direction();
  return {"offsets", joints, arm.tool(), arm.base()};
}

/// Whether one of the solutions is the posture q.
bool contains(const Arm& arm, const std::vector<Configuration>& solutions, const Configuration& q) {
  return std::any_of(solutions.begin(), solutions.end(), [&](const Configuration& solution) {
    return internal::same_posture(arm, solution, q, 1e-5);
  });
}

/// A search with the redundant joint at one of the complete values finds no other solution.
void expect_none_missing(const Arm& arm, const Pose& pose, const InverseResult& result,
                         double value) {
  Configuration seed = middle_configuration(arm);
  seed[result.grid->joint] = value;
  const InverseResult searched = inverse_kinematics(arm, pose,
                                                    {.seed = seed,
                                                     .method = InverseMethod::numerical,
                                                     .all = true,
                                                     .lock = result.grid->joint,
                                                     .max_restarts = 200});
  for (const Configuration& q : searched.solutions) {
    EXPECT_TRUE(contains(arm, result.solutions, q)) << arm.name() << ' ' << q.transpose();
  }
}

TEST(LockedJointGrid, NoSolutionIsMissingAtACompleteValue) {
  testing::Random random;
  const int arms = testing::slow_build ? 2 : 12;
  int complete = 0, solutions = 0;
  for (int i = 0; i < arms; ++i) {
    const Arm arm = i % 2 == 0 ? with_small_offsets(random) : seven_revolute(random);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const InverseResult result = inverse_kinematics(arm, pose, {.all = true, .grid = 16});
    testing::expect_solved(arm, pose, Task::spatial(), result);
    ASSERT_TRUE(result.grid) << result.method;
    EXPECT_FALSE(result.complete);
    ASSERT_EQ(result.grid->values.size(), 16U);
    complete += static_cast<int>(result.grid->complete.size());
    solutions += static_cast<int>(result.solutions.size());
    for (int k = 0; k < 4 && !result.grid->complete.empty(); ++k) {
      const int last = static_cast<int>(result.grid->complete.size()) - 1;
      expect_none_missing(arm, pose, result, result.grid->complete[random.integer(0, last)]);
    }
  }
  EXPECT_GE(complete, arms * 16 * 9 / 10);
  EXPECT_GE(solutions, arms * 8);
}

TEST(LockedJointGrid, SolutionsAreOnTheGridAndTheSameForEverySeed) {
  testing::Random random;
  const Arm arm = seven_revolute(random);
  const Pose pose = forward_kinematics(arm, random.configuration(arm));
  const InverseResult first = inverse_kinematics(arm, pose, {.all = true, .grid = 8});
  for (const Configuration& q : first.solutions) {
    double distance = 1;
    for (const double value : first.grid->values) {
      distance = std::min(distance, std::abs(q[first.grid->joint] - value));
    }
    EXPECT_LT(distance, 1e-6) << q.transpose();
  }
  const InverseResult again =
      inverse_kinematics(arm, pose, {.seed = random.configuration(arm), .all = true, .grid = 8});
  EXPECT_EQ(again.grid->complete, first.grid->complete);
  EXPECT_EQ(again.solutions.size(), first.solutions.size());
}

TEST(LockedJointGrid, TheClosedFormGivesOneSolutionToo) {
  testing::Random random;
  const Arm arm = with_small_offsets(random);
  const Pose pose = forward_kinematics(arm, random.configuration(arm));
  const InverseResult result =
      inverse_kinematics(arm, pose, {.method = InverseMethod::closed_form});
  testing::expect_solved(arm, pose, Task::spatial(), result);
  EXPECT_EQ(result.solutions.size(), 1U);
}

TEST(LockedJointGrid, ArmsWithThreeAxesThatMeetReportTheirGridToo) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Pose pose = forward_kinematics(arm, random.configuration(arm));
  const InverseResult result = inverse_kinematics(arm, pose, {.all = true, .grid = 20});
  testing::expect_solved(arm, pose, Task::spatial(), result);
  ASSERT_TRUE(result.grid);
  EXPECT_EQ(result.grid->joint, 6);
  EXPECT_EQ(result.grid->values.size(), 20U);
  EXPECT_GE(result.grid->complete.size(), 15U);
}

}  // namespace
}  // namespace beeline
