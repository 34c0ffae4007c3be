#include <gtest/gtest.h>
#include <tuple>

#include <beeline/inverse/internal/self_motion_dimension.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/math/decompositions.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

using internal::self_motion_dimension;

/// The number of independent directions in which solutions are found near q: of configurations that
/// are moved at random and brought back to the pose, the rank of their differences from q.
int found_directions(const Arm& arm, const Task& task, const Configuration& q,
                     testing::Random& random) {
  constexpr double step = 1e-3;
  const Pose goal = forward_kinematics(arm, q);
  const int trials = 3 * arm.dof();
  Eigen::MatrixXd differences(arm.dof(), trials);
  for (int i = 0; i < trials; ++i) {
    Configuration moved = q;
    for (double& value : moved) value += step * random.uniform(-1, 1);
    const internal::NumericalResult back = internal::levenberg_marquardt(
        arm, goal, task, internal::no_bounds(arm), moved, {.tolerance = 1e-12});
    EXPECT_TRUE(back.converged);
    differences.col(i) = (back.q - q) / step;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(differences);
  return static_cast<int>((svd.singularValues().array() > 0.05).count());
}

TEST(SelfMotionDimension, IsThatOfTheSolutionsNearby) {
  testing::Random random;
  const std::vector<std::pair<Arm, Task>> cases{
      {built_in("panda"), Task::spatial()},
      {built_in("ur5"), Task::spatial()},
      {built_in("ur5"), Task::position()},
      {built_in("panda"), Task::position()},
      {built_in("rrr"), Task::planar()},
      {arm_from_joint_string("RRRR"), Task::planar()},
      {arm_from_joint_string("RRRRR"), Task::spatial()},  // moves in a plane: rank 3
      {arm_from_joint_string("PPP"), Task::planar()},     // parallel slides: rank 1
      {built_in("scara"), Task::spatial()}};
  for (const auto& [arm, task] : cases) {
    for (int i = 0; i < 5; ++i) {
      const Configuration q = random.configuration(arm);
      EXPECT_EQ(self_motion_dimension(arm, task, forward_kinematics(arm, q), {q}),
                found_directions(arm, task, q, random))
          << arm.name() << " " << name(task) << " " << q.transpose();
    }
  }
}

int dimension_at(const Arm& arm, const Task& task, const Configuration& q) {
  return self_motion_dimension(arm, task, forward_kinematics(arm, q), {q});
}

TEST(SelfMotionDimension, IsFoundAtSingularConfigurations) {
  // Stretched arms: the solution is isolated, except for rotations about the line of the links.
  EXPECT_EQ(dimension_at(built_in("rrr"), Task::planar(), Configuration::Zero(3)), 0);
  EXPECT_EQ(
      dimension_at(arm_from_joint_string("RRRR"), task_named("110000"), Configuration::Zero(4)), 0);
  // Two axes of a wrist coincide: they rotate against each other.
  const Arm puma = built_in("puma560");
  EXPECT_EQ(dimension_at(puma, Task::spatial(), Configuration{{0.2, 0.6, -0.4, 0.5, 0, 0.3}}), 1);
}

// The tool of a stretched arm at the edge of its workspace, with rotations that the task leaves
// free: every solution is singular.
TEST(InverseKinematics, SaysThatSolutionsAreInfinitelyManyWhereEachIsSingular) {
  for (const auto& [name, task, x, y, z] :
       {std::tuple{"ur12e", "111010", 0.029898686595128898, -0.04923239319681974, 0.0197},
        std::tuple{"ur5", "111001", 0.02591160927505734, -0.007036405671702346, -0.822741}}) {
    const Arm arm = built_in(name);
    const bool ur5 = arm.name() == built_in("ur5").name();
    const Eigen::Quaterniond rotation =
        ur5 ? Eigen::Quaterniond(0.6857609818176487, -0.013309902688472318, -0.7069815036409535,
                                 -0.17242933571899688)
            : Eigen::Quaterniond(0.19057213296026673, 0.19057213296026662, -0.68094218707536,
                                 -0.6809421870753598);
    const InverseResult result =
        inverse_kinematics(arm, make_pose({x, y, z}, rotation.toRotationMatrix()),
                           {.task = task_named(task), .all = true, .max_restarts = 200});
    ASSERT_TRUE(result) << name;
    EXPECT_GT(result.solutions.size(), 20u) << name;
    EXPECT_GE(result.self_motion_dimension, 1) << name;
  }
}

TEST(InverseKinematics, SaysThatSolutionsAreInfinitelyMany) {
  testing::Random random;
  const std::vector<std::string> names = built_in_names();
  for (std::size_t i = 0; i < names.size(); i += testing::slow_build ? 5 : 1) {
    const std::string& name = names[i];
    const Arm arm = built_in(name);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const InverseResult result =
        inverse_kinematics(arm, pose, {.all = true, .grid = 8, .max_restarts = 50});
    ASSERT_TRUE(result) << name;
    EXPECT_EQ(result.self_motion_dimension, std::max(0, arm.dof() - default_task(arm).size()))
        << name;
    EXPECT_FALSE(result.complete && result.self_motion_dimension > 0) << name;
  }
}

// With a joint locked a redundant arm has finitely many solutions.
TEST(InverseKinematics, WithAJointLockedHasADimensionLess) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration q = random.configuration(arm);
  const InverseResult result =
      inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = q, .all = true, .lock = 6});
  ASSERT_TRUE(result);
  EXPECT_EQ(result.self_motion_dimension, 0);
}

}  // namespace
}  // namespace beeline
