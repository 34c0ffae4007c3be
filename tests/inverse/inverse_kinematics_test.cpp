#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/random_arm.h>

namespace beeline {
namespace {

using namespace internal;

using std::numbers::pi;

using testing::expect_no;
using testing::expect_solved;
using testing::largest;
using testing::named;

/// Joints about random axes, links of about `size`, angles within +-2.5 rad.
Arm revolute_arm(int joints, double size, testing::Random& random) {
  std::vector<Joint> chain;
  for (int i = 0; i < joints; ++i) {
    Joint joint;
    joint.offset = random.pose(size);
    joint.screw = rotation_screw(random.direction(), random.vector(size));
    chain.push_back(named(joint, "joint" + std::to_string(i + 1), -2.5, 2.5));
  }
  return {"random", chain};
}

TEST(InverseKinematics, ComesBackToEveryPoseOfEveryBuiltInArm) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (int i = 0; i < (testing::slow_build ? 20 : 1000); ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, default_task(arm), inverse_kinematics(arm, pose));
    }
  }
}

TEST(InverseKinematics, SaysThatAFarPositionIsRatherInMillimetres) {
  testing::Random random;
  for (const std::string name : {"panda", "ur5", "rrr", "scara"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 5; ++i) {
      Pose pose = forward_kinematics(arm, random.configuration(arm));
      const double height = pose.translation().z();
      pose.translation() *= 1000;
      if (arm.planar()) pose.translation().z() = height;
      const InverseResult result = inverse_kinematics(arm, pose);
      ASSERT_EQ(result.status, InverseStatus::unreachable) << name;
      EXPECT_EQ(result.reason.has(ReasonField::in_millimetres),
                (pose.translation() - arm.reach().centre).norm() > 10 * arm.reach().radius);
      pose.translation().x() += 4000 * arm.reach().radius;  // in millimetres out of reach as well
      EXPECT_FALSE(inverse_kinematics(arm, pose).reason.has(ReasonField::in_millimetres));
    }
  }
}

TEST(InverseKinematics, AtItsOwnSeedStaysThere) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::example_size(100); ++i) {
      const Configuration q = random.configuration(arm);
      const InverseResult result = inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = q});
      ASSERT_EQ(result.status, InverseStatus::solved);
      EXPECT_LT((result.solutions[0] - q).norm(), 1e-6) << name;
    }
  }
}

TEST(InverseKinematics, OfPlanarArmsGivesAllByDistanceFromTheSeed) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 500; ++i) {
    const Configuration q = random.configuration(arm), seed = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, q);
    const InverseResult all = inverse_kinematics(arm, pose, {.seed = seed, .all = true});
    expect_solved(arm, pose, Task::planar(), all);
    ASSERT_EQ(all.solutions.size(), 2U);
    EXPECT_EQ(all.method, "closed form: planar");
    EXPECT_TRUE(same_posture(arm, all.solutions[0], q) || same_posture(arm, all.solutions[1], q));
    EXPECT_LE((all.solutions[0] - seed).norm(), (all.solutions[1] - seed).norm());
    const InverseResult one = inverse_kinematics(arm, pose, {.seed = seed});
    ASSERT_EQ(one.solutions.size(), 1U);
    EXPECT_EQ(one.solutions[0], all.solutions[0]);
  }
}

TEST(InverseKinematics, MeetsAllEightPosturesOfPuma) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  const Configuration q = (Configuration(6) << 0.3, 0.9, -2.2, 0.5, 0.7, -0.4).finished();
  const Pose pose = forward_kinematics(arm, q);
  const InverseResult result =
      inverse_kinematics(arm, pose, {.all = true, .ignore_limits = true, .max_restarts = 300});
  ASSERT_EQ(result.status, InverseStatus::solved);
  EXPECT_EQ(result.solutions.size(), 8U);
  for (const Configuration& each : result.solutions) {
    EXPECT_LE(largest(task_deviation(Task::spatial(), pose, forward_kinematics(arm, each))), 1e-9);
  }
}

TEST(InverseKinematics, PutsAnglesOnTheTurnNearestToTheSeedWithinLimits) {
  testing::Random random;
  const Arm arm = built_in("ur5");  // limits +-2 pi
  for (int i = 0; i < 200; ++i) {
    const Configuration q = random.configuration(arm);
    const Configuration seed = q + Configuration::Constant(6, random.uniform(-0.01, 0.01));
    const InverseResult result =
        inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = seed});
    ASSERT_EQ(result.status, InverseStatus::solved);
    for (int k = 0; k < 6; ++k) {
      const double other = result.solutions[0][k] > seed[k] ? -2 * pi : 2 * pi;
      const double moved = result.solutions[0][k] + other;
      EXPECT_TRUE(std::abs(moved) > 2 * pi || std::abs(moved - seed[k]) >= pi - 1e-9);
    }
  }
}

TEST(InverseKinematics, FindsTheMembersOfAContinuumThatAreWithinLimits) {
  // Two slides in one direction: the nearest to the seed shares the way, and leaves the first's
  // limits; others do not.
  Joint slide;
  slide.screw = translation_screw(Vector3::UnitX());
  const Arm arm("slides", {named(slide, "short", 0, 0.1), named(slide, "long", 0, 2)});
  const Pose pose = make_pose({1.5, 0, 0});
  expect_solved(arm, pose, Task::planar(), inverse_kinematics(arm, pose));
  expect_no(inverse_kinematics(arm, make_pose({2.2, 0, 0})), InverseStatus::outside_limits);
}

TEST(InverseKinematics, MasksAndToolFrameLeaveTheRestFree) {
  testing::Random random;
  for (const char* arm_name : {"puma560", "panda"}) {
    const Arm arm = built_in(arm_name);
    for (const char* task_name :
         {"position", "111110:tool", "111001", "110001", "111000:tool", "000111", "011110:tool"}) {
      const Task task = task_named(task_name);
      for (int i = 0; i < 50; ++i) {
        Pose pose = forward_kinematics(arm, random.configuration(arm));
        if (std::string(task_name) == "111110:tool") {
          pose.linear() = pose.linear() * so3_exp(Vector3(0, 0, random.uniform(-3, 3)));
        }
        if (task == Task::position()) pose.linear() = random.rotation();
        expect_solved(arm, pose, task, inverse_kinematics(arm, pose, {.task = task}));
      }
    }
  }
}

TEST(InverseKinematics, WorksFromOneJointToAHundred) {
  testing::Random random;
  for (const int joints : {1, 2, 3, 4, 5, 7, 8, 30, 100}) {
    for (int i = 0; i < 20; ++i) {
      const Arm arm = revolute_arm(joints, 2.0 / joints, random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose));
    }
  }
}

TEST(InverseKinematics, SolvesHelicalAndMimicArms) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const Arm arm = testing::random_arm(random, 8, 4);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose));
  }
  // A finger: one motor, three planar joints that follow it.
  std::vector<Joint> finger = built_in("rrr").joints();
  finger[1].mimic = Mimic{finger[0].name, 0.7, 0};
  finger[2].mimic = Mimic{finger[0].name, 0.5, 0.1};
  const Arm arm("finger", finger);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    expect_solved(arm, pose, Task::planar(), inverse_kinematics(arm, pose));
  }
}

TEST(InverseKinematics, SingularSeedsAndPosesAreReached) {
  testing::Random random;
  for (const char* arm_name : {"puma560", "panda", "iiwa14", "ur5"}) {
    const Arm arm = built_in(arm_name);
    for (int i = 0; i < 50; ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, Task::spatial(),
                    inverse_kinematics(arm, pose, {.seed = Configuration::Zero(arm.dof())}));
    }
  }
  for (const char* arm_name : {"puma560", "iiwa14", "ur5", "rrr"}) {  // zero is stretched, or near
    const Arm arm = built_in(arm_name);
    Configuration q = Configuration::Zero(arm.dof());
    q[0] = 0.4;
    const Pose pose = forward_kinematics(arm, q);
    expect_solved(arm, pose, default_task(arm),
                  inverse_kinematics(arm, pose, {.seed = random.configuration(arm)}));
  }
}

TEST(InverseKinematics, LargeAndSmallArmsAreSolvedAlike) {
  testing::Random random;
  for (const double size : {1e-4, 1e-2, 1e2, 1e4, 1e5}) {
    for (int i = 0; i < testing::cases(60); ++i) {
      const Arm arm = revolute_arm(6, size, random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose),
                    std::max(1e-9, 1e-13 * size));
    }
  }
}

TEST(InverseKinematics, DependsOnTheRandomSeedAlone) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  std::vector<Pose> poses;
  std::vector<InverseResult> first;
  for (int i = 0; i < 50; ++i) {
    poses.push_back(forward_kinematics(arm, random.configuration(arm)));
    first.push_back(inverse_kinematics(arm, poses.back(), {.random_seed = 7}));
  }
  for (std::size_t i = poses.size(); i-- > 0;) {
    const InverseResult again = inverse_kinematics(arm, poses[i], {.random_seed = 7});
    EXPECT_EQ(again.solutions, first[i].solutions);
    EXPECT_EQ(again.iterations, first[i].iterations);
    EXPECT_EQ(again.restarts, first[i].restarts);
  }
}

TEST(InverseKinematics, FarSeedsDoNotSpoilTheAnswer) {
  testing::Random random;
  for (const char* arm_name : {"rrr", "rp", "puma560", "panda", "stanford"}) {
    const Arm arm = built_in(arm_name);
    for (const double far : {1e3, 1e9, 1e15, 1e300}) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(
          arm, pose, default_task(arm),
          inverse_kinematics(arm, pose, {.seed = Configuration::Constant(arm.dof(), far)}));
    }
  }
}

}  // namespace
}  // namespace beeline
