#include <gtest/gtest.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;

using testing::expect_no;
using testing::explained_inverse;
using testing::named;

TEST(InverseKinematics, OutOfReachSaysByHowMuch) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 200; ++i) {
    const double heading = random.uniform(-pi, pi), beyond = random.uniform(1e-6, 20);
    const Pose pose = to_space({(9 + beyond) * std::cos(heading), (9 + beyond) * std::sin(heading),
                                random.uniform(-pi, pi)});
    const InverseResult result = explained_inverse(arm, pose);
    expect_no(result, InverseStatus::unreachable);
    EXPECT_NEAR(result.residual, beyond, 1e-9);
    EXPECT_NEAR(testing::field<double>(result.reason, ReasonField::distance).value_or(0), beyond,
                1e-6 * beyond)
        << result.reason;
    ASSERT_TRUE(result.nearest.has_value());
    const Vector3 reached = result.nearest->world_T_tool.translation();
    EXPECT_LE((reached - 9 * Vector3(std::cos(heading), std::sin(heading), 0)).norm(), 1e-6);
  }
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
    const Arm spatial = built_in(name);
    const Vector3 way = (spatial.reach().radius + 0.25) * random.direction();
    const InverseResult far = explained_inverse(spatial, make_pose(spatial.reach().centre + way));
    expect_no(far, InverseStatus::unreachable);
    EXPECT_GE(far.residual, 0.25 - 1e-9);  // an offset may keep it farther away
    EXPECT_LE(far.residual, 0.25 + 0.15 * spatial.reach().radius);
  }
  // A pose that is reachable with a longer prismatic joint is outside the limits, and the reason
  // names the joint.
  const Arm stanford = built_in("stanford");
  const Pose pose =
      make_pose(stanford.reach().centre + Vector3(stanford.reach().radius + 0.25, 0, 0));
  const InverseResult slide = explained_inverse(stanford, pose, {.max_restarts = 10});
  expect_no(slide, InverseStatus::outside_limits);
  EXPECT_EQ(testing::joint(slide.reason), "joint3") << slide.reason;
  ASSERT_TRUE(slide.nearest.has_value());
  EXPECT_EQ(slide.nearest->blocking, 2);
  EXPECT_GT(slide.nearest->excess, 0);
}

TEST(InverseKinematics, InsideTheShouldersOffsetNoWristArrives) {
  // A point on the axis of joint 1. The tool never comes nearer to that axis than the offset of
  // 0.15005 m.
  const InverseResult puma = explained_inverse(built_in("puma560"), make_pose({0.01, 0, 0}));
  expect_no(puma, InverseStatus::unreachable);
  EXPECT_NEAR(puma.residual, 0.15005 - 0.01, 1e-6);
}

TEST(InverseKinematics, AReachedPositionWithTheWrongOrientationSaysHowMuchTurnIsMissing) {
  // The wrist would have to be at (-9, 0), 2 m beyond its reach of 7 m. With the hand rotated by
  // acos(...), from the triangle of sides 7 (wrist), 2 (hand) and 7 (tool), it is at the boundary.
  const InverseResult turned = explained_inverse(built_in("rrr"), to_space({-7, 0, 0}));
  expect_no(turned, InverseStatus::orientation_unreachable);
  const double least = std::acos((7 * 7 - 7 * 7 - 2 * 2) / (2.0 * 7 * 2));
  EXPECT_NEAR(turned.residual, least, 2e-3);  // a stretched arm is approached slowly
  // Five joints and a spatial task: the tool of a puma without its last joint has one degree of
  // freedom less. For the pose rotated about the tool's z axis, the whole rotation remains as an
  // error.
  std::vector<Joint> joints = built_in("puma560").joints();
  joints.pop_back();
  const Arm five("five", joints);
  testing::Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    Pose pose = forward_kinematics(five, random.configuration(five));
    pose.linear() = pose.linear() * so3_exp(Vector3(0.3, 0, 0));
    const InverseResult no = explained_inverse(five, pose, {.ignore_limits = true});
    expect_no(no, InverseStatus::orientation_unreachable);
    EXPECT_LE(no.residual, 0.3 + 1e-6);
    EXPECT_LE(no.nearest->error.position, 1e-9);
  }
}

TEST(InverseKinematics, WhatNoJointCanChangeIsProvedUnreachable) {
  const Arm scara = built_in("scara"), rrr = built_in("rrr"), gantry = built_in("gantry");
  const double heading = to_plane(forward_kinematics(gantry, Configuration::Zero(2))).theta;
  testing::Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const double off = random.uniform(1e-6, 3);
    Pose tilted = forward_kinematics(scara, random.configuration(scara));
    const double tilt = random.uniform(1e-6, 3);
    tilted.linear() = tilted.linear() * so3_exp(Vector3(tilt, 0, 0));
    const InverseResult no = explained_inverse(scara, tilted);
    expect_no(no, InverseStatus::orientation_unreachable);
    EXPECT_NEAR(no.residual, tilt, 1e-9);
    EXPECT_EQ(explained_inverse(scara, tilted, {.task = Task::position()}).status,
              InverseStatus::solved);

    Pose lifted = forward_kinematics(rrr, random.configuration(rrr));
    lifted.translation().z() = off;
    for (const Task& task : {Task::spatial(), Task::position()}) {
      const InverseResult above = explained_inverse(rrr, lifted, {.task = task});
      expect_no(above, InverseStatus::unreachable);
      EXPECT_NEAR(above.residual, off, 1e-9);
    }
    EXPECT_EQ(explained_inverse(rrr, lifted, {.task = Task::planar()}).status,
              InverseStatus::solved);

    const InverseResult turned =
        explained_inverse(gantry, to_space({0.1, 0.2, heading + off}), {.ignore_limits = true});
    expect_no(turned, InverseStatus::orientation_unreachable);
    EXPECT_NEAR(turned.residual, off, 1e-9);
  }
}

TEST(InverseKinematics, ReachableOnlyOutsideLimitsNamesTheJoint) {
  testing::Random random;
  const Arm chapter = built_in("rrr");
  std::vector<Joint> joints = chapter.joints();
  joints[1].limits.lower = 0.2;  // joint 2 has a small range, to one side
  joints[1].limits.upper = 0.4;
  const Arm planar("narrow", joints);
  for (int i = 0; i < 100; ++i) {
    Configuration q = random.configuration(planar);
    q[1] = random.uniform(0.6, 2.5) * (random.integer(0, 1) == 1 ? 1 : -1);
    const InverseResult no = explained_inverse(planar, forward_kinematics(planar, q));
    expect_no(no, InverseStatus::outside_limits);
    EXPECT_EQ(testing::joint(no.reason), "joint2");
    EXPECT_NEAR(testing::field<double>(no.reason, ReasonField::value).value_or(0), std::abs(q[1]),
                1e-6)
        << no.reason;
    EXPECT_EQ(
        explained_inverse(planar, forward_kinematics(planar, q), {.ignore_limits = true}).status,
        InverseStatus::solved);
  }
  // A puma whose elbow is nearly locked: joint 3 determines the distance from shoulder to wrist.
  joints = built_in("puma560").joints();
  joints[2].limits.lower = -1.6;
  joints[2].limits.upper = -1.5;
  const Arm puma("locked", joints);
  for (int i = 0; i < 5; ++i) {
    Configuration q = random.configuration(built_in("puma560"));
    q[2] = -1 + random.uniform(-0.1, 0.1);
    const InverseResult no =
        explained_inverse(puma, forward_kinematics(puma, q), {.max_restarts = 30});
    expect_no(no, InverseStatus::outside_limits);
    EXPECT_NE(testing::joint(no.reason), "") << no.reason;
    EXPECT_GT(no.residual, 1e-9);
  }
  // A prismatic joint that is too short: the reason is its limits, not the geometry.
  const Arm rp("short",
               {built_in("rp").joints()[0], named(built_in("rp").joints()[1], "slide", 0, 0.5)});
  const InverseResult no = explained_inverse(rp, to_space({3, 0, 0}));
  expect_no(no, InverseStatus::outside_limits);
  EXPECT_EQ(testing::joint(no.reason), "slide");
  EXPECT_NEAR(testing::field<double>(no.reason, ReasonField::excess).value_or(0), 1.5, 1e-9);
  EXPECT_EQ(testing::field<double>(no.reason, ReasonField::limit), 0.5);
}

TEST(InverseKinematics, RefusesWhatMakesNoSense) {
  const Arm arm = built_in("rrr");
  const Pose pose = to_space({4, 5, 0});
  Pose nan = pose, stretched = pose, mirrored = pose;
  nan.linear()(0, 1) = std::nan("");
  stretched.linear() *= 1.01;
  mirrored.linear().col(2) *= -1;
  EXPECT_REFUSED(inverse_kinematics(arm, nan), "not finite");
  EXPECT_REFUSED(inverse_kinematics(arm, stretched), "not a rigid motion");
  EXPECT_REFUSED(inverse_kinematics(arm, mirrored), "not a rigid motion");
  EXPECT_REFUSED(inverse_kinematics(arm, make_pose({1e200, 0, 0})), "1e100 m");
  const Configuration two = Configuration::Zero(2);
  const Configuration no_number = Configuration::Constant(3, std::nan(""));
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.seed = two}), "takes 3 joint values");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.seed = no_number}), "joint1 is nan");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.task = Task{.rows = {}}}), "at least one row");
  const Task spatial{.frame = Frame::space};
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.task = spatial}),
                 "in the axes of the base or of the tool");
  for (const double tolerance : {0.0, -1e-9, std::nan(""), Limits::none}) {
    EXPECT_REFUSED(inverse_kinematics(arm, pose, {.tolerance = tolerance}), "tolerance is ");
  }
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.max_iterations = -1}), "max_iterations is -1");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.max_restarts = -1}), "max_restarts is -1");
  // A rotation rounded in text is orthonormalised, not refused.
  Pose rounded = pose;
  rounded.linear()(0, 0) += 1e-7;
  EXPECT_EQ(inverse_kinematics(arm, rounded).status, InverseStatus::solved);
}

}  // namespace
}  // namespace beeline
