#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;

/// All 63 masks in both frames.
std::vector<Task> all_tasks() {
  std::vector<Task> tasks;
  for (unsigned bits = 1; bits < 64; ++bits) {
    for (const Frame frame : {Frame::base, Frame::tool}) {
      Task task;
      task.frame = frame;
      for (std::size_t i = 0; i < 6; ++i) task.rows[i] = ((bits >> i) & 1) != 0;
      tasks.push_back(task);
    }
  }
  return tasks;
}

TEST(Task, HasANameThatReadsBackForEveryMaskAndFrame) {
  for (const Task& task : all_tasks()) EXPECT_EQ(task_named(name(task)), task) << name(task);
  for (const char* text : {"spatial", "planar", "position", "spatial:tool", "000001", "planar:tool",
                           "position:tool", "direction", "direction:x", "direction:y",
                           "approach:xy", "approach:xz", "approach:yz", "111010:tool"}) {
    EXPECT_EQ(name(task_named(text)), text);
  }
}

TEST(Task, NamedTasksAreTheirMasks) {
  EXPECT_EQ(task_named("111111"), Task::spatial());
  EXPECT_EQ(task_named("111000"), Task::position());
  EXPECT_EQ(task_named("110001"), Task::planar());
  EXPECT_EQ(Task::spatial().size(), 6);
  EXPECT_EQ(Task::position().size(), 3);
  EXPECT_EQ(Task::planar().size(), 3);
  EXPECT_EQ(task_named("111110:tool").frame, Frame::tool);
  EXPECT_EQ(task_named("direction"), task_named("111110:tool"));
  EXPECT_EQ(task_named("direction:x"), task_named("111011:tool"));
  EXPECT_EQ(task_named("direction:y"), task_named("111101:tool"));
  EXPECT_EQ(task_named("approach:xy"), task_named("111110"));
  EXPECT_EQ(task_named("approach:xz"), task_named("111101"));
  EXPECT_EQ(task_named("approach:yz"), task_named("111011"));
  EXPECT_EQ(task_named("111"), Task::planar());
  EXPECT_EQ(task_named("110"), task_named("110000"));
  EXPECT_EQ(task_named("001:tool"), task_named("000001:tool"));
}

TEST(Task, RefusesOtherNamesAndListsTheKnownOnes) {
  for (const char* text : {"",
                           "spatail",
                           "000000",
                           "000000:tool",
                           "000",
                           "112",
                           "11",
                           "11111",
                           "1111111",
                           "11111x",
                           "11112 ",
                           ":tool",
                           "spatial:tool:tool",
                           "spatial:base",
                           "Spatial",
                           "direction:tool",
                           "direction:xy",
                           "approach",
                           "approach:zx",
                           "approach:xy:tool"}) {
    EXPECT_REFUSED(task_named(text), "unknown task \"" + std::string(text) + "\"");
    EXPECT_REFUSED(task_named(text), "planar, position, spatial");
  }
  EXPECT_LT(testing::refusal([] { task_named(std::string(100000, '1')); }).size(), 400);
}

TEST(Task, IsPlanarForPlanarArmsByDefaultAndSpatialForOthers) {
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    EXPECT_EQ(default_task(arm), arm.planar() ? Task::planar() : Task::spatial()) << name;
  }
}

TEST(Task, NamesItsRowsInOrder) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(row_names(Task::planar()), (Names{"x", "y", "theta"}));
  EXPECT_EQ(row_names(Task::spatial()), (Names{"vx", "vy", "vz", "wx", "wy", "wz"}));
  EXPECT_EQ(row_names(Task::position()), (Names{"vx", "vy", "vz"}));
  EXPECT_EQ(row_names(task_named("001010:tool")), (Names{"vz", "wy"}));
  for (const Task& task : all_tasks()) EXPECT_EQ(row_names(task).size(), task.size());
}

TEST(Task, KeepsItsRowsOfTwistsAndJacobians) {
  testing::Random random;
  const Arm arm = testing::random_arm(random, 7, 4);
  const Configuration q = random.configuration(arm);
  Twist twist;
  twist << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(task_rows(Task::planar(), twist), Eigen::Vector3d(1, 2, 6));
  EXPECT_EQ(task_rows(Task::spatial(), twist), twist);
  for (const Task& task : all_tasks()) {
    const Jacobian all = jacobian(arm, q, task.frame);
    const Eigen::MatrixXd kept = task_jacobian(arm, q, task);
    ASSERT_EQ(kept.rows(), task.size());
    ASSERT_EQ(kept.cols(), arm.dof());
    for (int k = 0; k < arm.dof(); ++k) ASSERT_EQ(kept.col(k), task_rows(task, all.col(k)));
  }
  EXPECT_EQ(task_jacobian(built_in("rrr"), Eigen::Vector3d(1, 2, 3), Task::planar()),
            planar_jacobian(built_in("rrr"), Eigen::Vector3d(1, 2, 3)));
}

TEST(TaskError, IsTheDifferenceFromCurrentToDesired) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const Pose current = random.pose(2), desired = random.pose(2);
    const Eigen::VectorXd base = task_error(Task::spatial(), desired, current);
    ASSERT_EQ(base.head<3>(), desired.translation() - current.translation());
    ASSERT_LT((so3_exp(base.tail<3>()) * current.linear() - desired.linear()).norm(), 3e-14);
    const Eigen::VectorXd tool = task_error(task_named("spatial:tool"), desired, current);
    ASSERT_LT((current * Vector3(tool.head<3>()) - desired.translation()).norm(), 3e-14);
    ASSERT_LT((current.linear() * so3_exp(tool.tail<3>()) - desired.linear()).norm(), 3e-14);
    ASSERT_LE(base.tail<3>().norm(), pi + 1e-14);
    ASSERT_EQ(task_error(Task::spatial(), current, current).head<3>(), Vector3::Zero());
    ASSERT_LT(task_error(Task::spatial(), current, current).norm(), 3e-15);
    for (const Task& task : {Task::position(), Task::planar(), task_named("010110")}) {
      ASSERT_EQ(task_error(task, desired, current), task_rows(task, base));
    }
  }
}

TEST(TaskError, IsTheJacobianTimesAShortStep) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, 5, 3);
    const Configuration q = random.configuration(arm);
    Configuration step(arm.dof());
    for (double& value : step) value = random.uniform(-1, 1) * 1e-7;
    const Pose current = forward_kinematics(arm, q), desired = forward_kinematics(arm, q + step);
    for (const char* text : {"spatial", "spatial:tool", "101010", "101010:tool"}) {
      const Task task = task_named(text);
      const Eigen::VectorXd error = task_error(task, desired, current);
      ASSERT_LT((error - task_jacobian(arm, q, task) * step).norm(), 1e-11) << text;
    }
  }
}

TEST(TaskError, HasTheSmallestAngleOnBothSidesOfPi) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const double from = random.uniform(-pi, pi);
    const double off = random.uniform(-1, 1) * std::pow(10, random.uniform(-9, 0));
    const double to = from + pi + off;  // slightly more or less than pi away
    const Eigen::VectorXd error =
        task_error(Task::planar(), to_space({1, 2, to}), to_space({0, 0, from}));
    ASSERT_LE(std::abs(error[2]), pi + 4e-15);
    if (std::abs(off) < 1e-14) continue;  // there both rotations are equally short
    ASSERT_NEAR(error[2], angle_difference(to, from), 1e-14);
    ASSERT_EQ(error[2]<0, off> 0) << "beyond pi the opposite rotation is shorter";
  }
  for (const double turn : {pi, -pi}) {
    const Eigen::VectorXd error = task_error(Task::planar(), to_space({0, 0, turn}), to_space({}));
    EXPECT_NEAR(std::abs(error[2]), pi, 1e-15);
  }
}

TEST(TaskError, IgnoresRotationAboutTheToolsAxisWhenTheTaskDoes) {
  testing::Random random;
  const Task pointing = task_named("111110:tool");
  for (int i = 0; i < 1000; ++i) {
    const Pose current = random.pose();
    Pose spun = current;
    spun.linear() = current.linear() * so3_exp(random.uniform(-3, 3) * Vector3::UnitZ());
    ASSERT_LT(task_error(pointing, spun, current).norm(), 3e-14);
    const Pose tilted(spun * Eigen::AngleAxisd(0.1, Vector3::UnitX()));
    ASSERT_GT(task_error(pointing, tilted, current).norm(), 1e-3);
  }
}

TEST(TaskDeviation, IsTheNormsOfTheTasksRows) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Pose current = random.pose(2), desired = random.pose(2);
    const Deviation all = task_deviation(Task::spatial(), desired, current);
    ASSERT_NEAR(all.position, (desired.translation() - current.translation()).norm(), 3e-15);
    const Rotation turn = desired.linear() * current.linear().transpose();
    ASSERT_NEAR(all.orientation, Eigen::AngleAxisd(turn).angle(), 3e-14);
    const Deviation tool = task_deviation(task_named("spatial:tool"), desired, current);
    ASSERT_NEAR(tool.position, all.position, 3e-14) << "the norms do not depend on the axes";
    ASSERT_NEAR(tool.orientation, all.orientation, 3e-14);
    ASSERT_EQ(task_deviation(Task::position(), desired, current).orientation, 0);
    for (const Task& task : all_tasks()) {
      const Deviation part = task_deviation(task, desired, current);
      ASSERT_NEAR(std::hypot(part.position, part.orientation),
                  task_error(task, desired, current).norm(), 3e-14);
    }
  }
}

}  // namespace
}  // namespace beeline
