#include <gtest/gtest.h>
#include <limits>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using Eigen::MatrixXd;

TEST(BatchInverse, IsTheSolversAnswers) {
  testing::Random random;
  for (const char* name : {"ur5", "panda", "rrr"}) {
    const Arm arm = built_in(name);
    const Eigen::Index count = 100;
    MatrixXd goal(arm.dof(), count), seeds(arm.dof(), count), poses(16, count), seven(7, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      goal.col(i) = random.configuration(arm);
      seeds.col(i) = random.configuration(arm);
    }
    batch_forward<double>(arm, goal, poses);
    poses.col(50).segment<2>(12).setConstant(1e3);  // out of reach
    poses(3, 60) = std::numeric_limits<double>::quiet_NaN();

    MatrixXd q(arm.dof(), count), one = MatrixXd::Zero(arm.dof(), 1);
    const Eigen::Index solved = batch_inverse(arm, poses, seeds, q, {}, {.threads = 2}).solved;
    Eigen::Index expected = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      Pose pose;
      pose.matrix() = poses.col(i).reshaped(4, 4);
      const bool found = i != 60 && inverse_kinematics(arm, pose, seeds.col(i), one) == 1;
      expected += found;
      if (found) {
        EXPECT_EQ(q.col(i), one.col(0));
      } else {
        EXPECT_TRUE(q.col(i).array().isNaN().all());
      }
    }
    EXPECT_EQ(solved, expected);
    EXPECT_GE(solved, 90);

    MatrixXd again(arm.dof(), count);
    for (const int threads : {1, 3}) {
      EXPECT_EQ(batch_inverse(arm, poses, seeds, again, {}, {.threads = threads}).solved, solved);
      EXPECT_TRUE(
          (again.array() == q.array() || (again.array().isNaN() && q.array().isNaN())).all());
    }
  }
}

/// The arm with its joints' frames turned by angles that a description has rounded.
Arm with_rounded_angles(const Arm& arm, testing::Random& random) {
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.offset.linear() = joint.offset.linear() * so3_exp(3e-10 * random.direction());
  }
  return {"rounded", joints, arm.tool()};
}

// The closed form takes such axes for parallel or meeting, and is off by 1e-10 m and more.
TEST(BatchInverse, KeepsTheToleranceForAnArmWithRoundedAngles) {
  testing::Random random;
  int closed = 0;
  for (const char* name : {"puma560", "ur5", "panda"}) {
    const Arm arm = with_rounded_angles(built_in(name), random);
    closed += inverse_method(arm).starts_with("closed form") ? 1 : 0;
    constexpr int rows = 200;
    Eigen::MatrixXd poses(16, rows), q(arm.dof(), rows);
    for (int i = 0; i < rows; ++i) {
      poses.col(i) = forward_kinematics(arm, random.configuration(arm)).matrix().reshaped();
    }
    for (const double tolerance : {1e-10, 1e-12}) {
      const BatchResult result =
          batch_inverse(arm, poses, middle_configuration(arm), q, {.tolerance = tolerance});
      EXPECT_GE(result.solved, rows - 2) << name;
      for (int i = 0; i < rows; ++i) {
        if (std::isnan(q(0, i))) continue;
        const Pose goal(Eigen::Map<const Eigen::Matrix4d>(poses.col(i).data()));
        const Deviation off =
            task_deviation(Task::spatial(), goal, forward_kinematics(arm, q.col(i)));
        EXPECT_LE(std::max(off.position, off.orientation), 1.001 * tolerance) << name;
      }
    }
  }
  EXPECT_GT(closed, 0);
}

// A pose that a single call refuses is an error of the argument, whatever the other rows are.
TEST(BatchInverse, NamesTheRowThatIsNoPoseOfTheArm) {
  const Arm planar = built_in("rrr"), ur5 = built_in("ur5");
  for (const Arm* const arm : {&planar, &ur5}) {
    MatrixXd poses(16, 5), q(arm->dof(), 5);
    const MatrixXd seed = middle_configuration(*arm);
    batch_forward<double>(*arm, seed.replicate(1, 5), poses);
    EXPECT_EQ(batch_inverse(*arm, poses, seed, q).solved, 5);
    poses(0, 1) = std::numeric_limits<double>::quiet_NaN();  // no solution, and no error
    EXPECT_EQ(batch_inverse(*arm, poses, seed, q).solved, 4);
    EXPECT_TRUE(q.col(1).array().isNaN().all());
    poses(0, 3) += 0.1;
    EXPECT_REFUSED(batch_inverse(*arm, poses, seed, q), "pose 4 of 5: the pose");
  }
  MatrixXd poses(16, 3), q(3, 3);
  const MatrixXd seed = middle_configuration(planar);
  batch_forward<double>(planar, seed.replicate(1, 3), poses);
  poses(14, 2) += 0.1;
  EXPECT_REFUSED(batch_inverse(planar, poses, seed, q),
                 "pose 3 of 3: the pose is outside the plane");
  EXPECT_EQ(batch_inverse(planar, poses, seed, q, {.task = Task::planar()}).solved, 3);
}

TEST(BatchInverse, TakesQuaternionsAndOneSeedForAll) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  MatrixXd goal(6, 40), poses(7, 40), q(6, 40), reached(7, 40);
  for (Eigen::Index i = 0; i < 40; ++i) goal.col(i) = random.configuration(arm);
  const BatchOptions options{.layout = PoseLayout::position_quaternion};
  batch_forward<double>(arm, goal, poses, options);
  EXPECT_EQ(batch_inverse(arm, poses, goal.col(0), q, {}, options).solved, 40);
  batch_forward<double>(arm, q, reached, options);
  for (Eigen::Index i = 0; i < 40; ++i) {
    const double sign = reached.col(i).tail<4>().dot(poses.col(i).tail<4>()) < 0 ? -1 : 1;
    reached.col(i).tail<4>() *= sign;
  }
  EXPECT_LE((reached - poses).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace beeline
