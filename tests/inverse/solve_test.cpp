#include <gtest/gtest.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/representative.h>
#include <beeline/inverse/solve.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/composite.h>
#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>

#include <tests/random.h>

namespace beeline {
namespace {

constexpr double pi = std::numbers::pi;

double largest(const Deviation& error) { return std::max(error.position, error.orientation); }

/// Checks all that is promised of a solved answer, by forward kinematics alone.
void expect_solved(const Arm& arm, const Pose& pose, const Task& task, const InverseResult& result,
                   double tolerance = 1e-9) {
  ASSERT_EQ(result.status, InverseStatus::solved) << arm.name() << ": " << result.reason;
  ASSERT_FALSE(result.solutions.empty());
  EXPECT_TRUE(result.reason.empty());
  double residual = 0;
  for (const Configuration& q : result.solutions) {
    EXPECT_TRUE(within(bounds_of(arm), q)) << arm.name() << ' ' << q.transpose();
    residual = std::max(residual, largest(task_deviation(task, pose, forward_kinematics(arm, q))));
  }
  EXPECT_LE(residual, tolerance) << arm.name();
  EXPECT_NEAR(residual, result.residual, 1e-12);
}

void expect_no(const InverseResult& result, InverseStatus status) {
  EXPECT_EQ(result.status, status) << name(result.status) << ": " << result.reason;
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_FALSE(result.reason.empty());
  EXPECT_EQ(result.reason.find('\n'), std::string::npos);
  EXPECT_TRUE(std::isfinite(result.residual));
}

Joint named(Joint joint, const std::string& name, double lower = -Limits::none,
            double upper = Limits::none) {
  joint.name = name;
  joint.limits.lower = lower;
  joint.limits.upper = upper;
  return joint;
}

/// Joints about random axes, links of about `size`, angles within +-2.5 rad.
Arm random_arm(int joints, double size, testing::Random& random) {
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
    for (int i = 0; i < 1000; ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, default_task(arm), inverse_kinematics(arm, pose));
    }
  }
}

TEST(InverseKinematics, AtItsOwnSeedStaysThere) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 100; ++i) {
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
    EXPECT_EQ(all.method, "planar closed form");
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
      inverse_kinematics(arm, pose, {.all = true, .ignore_limits = true, .restarts = 300});
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

TEST(InverseKinematics, OutOfReachSaysByHowMuch) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 200; ++i) {
    const double heading = random.uniform(-pi, pi), beyond = random.uniform(1e-6, 20);
    const Pose pose = to_space({(9 + beyond) * std::cos(heading), (9 + beyond) * std::sin(heading),
                                random.uniform(-pi, pi)});
    const InverseResult result = inverse_kinematics(arm, pose);
    expect_no(result, InverseStatus::unreachable);
    EXPECT_NEAR(result.residual, beyond, 1e-9);
    EXPECT_NE(result.reason.find(number(beyond) + " m beyond"), std::string::npos) << result.reason;
  }
  // Within the ball of 9 m, but not with this orientation: the wrist would be at (-9, 0).
  const InverseResult turned = inverse_kinematics(arm, to_space({-7, 0, 0}));
  expect_no(turned, InverseStatus::unreachable);
  EXPECT_NEAR(turned.residual, 2, 1e-9);
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
    const Arm spatial = built_in(name);
    const Vector3 way = (spatial.reach().radius + 0.25) * random.direction();
    const InverseResult far = inverse_kinematics(spatial, make_pose(spatial.reach().centre + way));
    expect_no(far, InverseStatus::unreachable);
    EXPECT_NEAR(far.residual, 0.25, 1e-9);
  }
  // What a longer slide would reach is the limits' doing, and the reason names it.
  const Arm stanford = built_in("stanford");
  const Pose pose =
      make_pose(stanford.reach().centre + Vector3(stanford.reach().radius + 0.25, 0, 0));
  const InverseResult slide = inverse_kinematics(stanford, pose, {.restarts = 10});
  expect_no(slide, InverseStatus::outside_limits);
  EXPECT_NE(slide.reason.find("0.25 m beyond the reach"), std::string::npos) << slide.reason;
  EXPECT_NE(slide.reason.find("joint3 would be at"), std::string::npos) << slide.reason;
}

TEST(InverseKinematics, WhatNoJointCanChangeIsProvedUnreachable) {
  const Arm scara = built_in("scara"), rrr = built_in("rrr"), gantry = built_in("gantry");
  const double heading = to_plane(forward_kinematics(gantry, Configuration::Zero(2))).theta;
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const double off = random.uniform(1e-6, 3);
    Pose tilted = forward_kinematics(scara, random.configuration(scara));
    const double tilt = random.uniform(1e-6, 3);
    tilted.linear() = tilted.linear() * so3_exp(Vector3(tilt, 0, 0));
    const InverseResult no = inverse_kinematics(scara, tilted);
    expect_no(no, InverseStatus::unreachable);
    EXPECT_NEAR(no.residual, tilt, 1e-9);
    EXPECT_EQ(inverse_kinematics(scara, tilted, {.task = Task::position()}).status,
              InverseStatus::solved);

    Pose lifted = forward_kinematics(rrr, random.configuration(rrr));
    lifted.translation().z() = off;
    for (const Task& task : {Task::spatial(), Task::position()}) {
      const InverseResult above = inverse_kinematics(rrr, lifted, {.task = task});
      expect_no(above, InverseStatus::unreachable);
      EXPECT_NEAR(above.residual, off, 1e-9);
    }
    EXPECT_EQ(inverse_kinematics(rrr, lifted).status, InverseStatus::solved);

    const InverseResult turned =
        inverse_kinematics(gantry, to_space({0.1, 0.2, heading + off}), {.ignore_limits = true});
    expect_no(turned, InverseStatus::unreachable);
    EXPECT_NEAR(turned.residual, off, 1e-9);
  }
}

TEST(InverseKinematics, ReachableOnlyOutsideLimitsNamesTheJoint) {
  testing::Random random;
  const Arm chapter = built_in("rrr");
  std::vector<Joint> joints = chapter.joints();
  joints[1].limits.lower = 0.2;  // joint 2 bends little, and to the left only
  joints[1].limits.upper = 0.4;
  const Arm planar("narrow", joints);
  for (int i = 0; i < 100; ++i) {
    Configuration q = random.configuration(planar);
    q[1] = random.uniform(0.6, 2.5) * (random.integer(0, 1) == 1 ? 1 : -1);
    const InverseResult no = inverse_kinematics(planar, forward_kinematics(planar, q));
    expect_no(no, InverseStatus::outside_limits);
    EXPECT_NE(no.reason.find("joint2 would be at " + angle(std::abs(q[1])) + ", " +
                             angle(std::abs(q[1]) - 0.4) + " above"),
              std::string::npos)
        << no.reason;
    EXPECT_EQ(
        inverse_kinematics(planar, forward_kinematics(planar, q), {.ignore_limits = true}).status,
        InverseStatus::solved);
  }
  // A puma whose elbow is nearly locked: its distance from shoulder to wrist is settled by joint 3.
  joints = built_in("puma560").joints();
  joints[2].limits.lower = -1.6;
  joints[2].limits.upper = -1.5;
  const Arm puma("locked", joints);
  for (int i = 0; i < 5; ++i) {
    Configuration q = random.configuration(built_in("puma560"));
    q[2] = -1 + random.uniform(-0.1, 0.1);
    const InverseResult no =
        inverse_kinematics(puma, forward_kinematics(puma, q), {.restarts = 30});
    expect_no(no, InverseStatus::outside_limits);
    EXPECT_NE(no.reason.find("joint"), std::string::npos);
    EXPECT_GT(no.residual, 1e-9);
  }
  // A slide that is too short: limits, not geometry.
  const Arm rp("short",
               {built_in("rp").joints()[0], named(built_in("rp").joints()[1], "slide", 0, 0.5)});
  const InverseResult no = inverse_kinematics(rp, to_space({3, 0, 0}));
  expect_no(no, InverseStatus::outside_limits);
  EXPECT_NE(no.reason.find("joint slide would be at 2 m, 1.5 m above its upper limit 0.5 m"),
            std::string::npos)
      << no.reason;
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
      const Arm arm = random_arm(joints, 2.0 / joints, random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose));
    }
  }
}

TEST(InverseKinematics, SolvesHelicalAndMimicArms) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    std::vector<Joint> joints = random_arm(7, 0.3, random).joints();
    joints[2].screw = rotation_screw(random.direction(), random.vector(0.3), 0.05);
    joints[4].screw = translation_screw(random.direction());
    joints[5].mimic = Mimic{"joint2", random.integer(0, 1) == 1 ? -0.5 : 2, 0.1};
    const Arm arm("mixed", joints);
    ASSERT_EQ(arm.dof(), 6);
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
  for (const double size : {1e-4, 1e-2, 1e2, 1e4, 1e6, 1e8}) {
    for (int i = 0; i < 20; ++i) {
      const Arm arm = random_arm(6, size, random);
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

TEST(InverseKinematics, GivesUpWithTheNearestMissWhereNothingIsProved) {
  const Arm arm = built_in("puma560");
  // Inside the ball of reach, but inside the shoulder's offset: no wrist gets there.
  const InverseResult result = inverse_kinematics(arm, make_pose({0.01, 0, 0}), {.restarts = 20});
  expect_no(result, InverseStatus::not_found);
  EXPECT_GT(result.residual, 0.01);
  EXPECT_EQ(result.restarts, 40);  // 20 within limits, and 20 without them
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

TEST(InverseKinematics, RefusesWhatMakesNoSense) {
  const Arm arm = built_in("rrr");
  const Pose pose = to_space({4, 5, 0});
  Pose nan = pose, stretched = pose, mirrored = pose;
  nan.linear()(0, 1) = std::nan("");
  stretched.linear() *= 1.01;
  mirrored.linear().col(2) *= -1;
  EXPECT_THROW(inverse_kinematics(arm, nan), Error);
  EXPECT_THROW(inverse_kinematics(arm, stretched), Error);
  EXPECT_THROW(inverse_kinematics(arm, mirrored), Error);
  EXPECT_THROW(inverse_kinematics(arm, make_pose({1e200, 0, 0})), Error);
  EXPECT_THROW(inverse_kinematics(arm, pose, {.seed = Configuration::Zero(2)}), Error);
  EXPECT_THROW(inverse_kinematics(arm, pose, {.seed = Configuration::Constant(3, std::nan(""))}),
               Error);
  EXPECT_THROW(inverse_kinematics(arm, pose, {.task = Task{.rows = {}}}), Error);
  EXPECT_THROW(inverse_kinematics(arm, pose, {.task = Task{.frame = Frame::space}}), Error);
  for (const double tolerance : {0.0, -1e-9, std::nan(""), Limits::none}) {
    EXPECT_THROW(inverse_kinematics(arm, pose, {.tolerance = tolerance}), Error);
  }
  EXPECT_THROW(inverse_kinematics(arm, pose, {.iterations = -1}), Error);
  EXPECT_THROW(inverse_kinematics(arm, pose, {.restarts = -1}), Error);
  // Rounded from text, a rotation is mended, not refused.
  Pose rounded = pose;
  rounded.linear()(0, 0) += 1e-7;
  EXPECT_EQ(inverse_kinematics(arm, rounded).status, InverseStatus::solved);
}

}  // namespace
}  // namespace beeline
