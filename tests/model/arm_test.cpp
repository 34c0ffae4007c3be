#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <sstream>

#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = Limits::none;

Joint turning(const std::string& name) {
  Joint joint;
  joint.name = name;
  joint.screw = rotation_screw(Vector3::UnitZ());
  return joint;
}

/// An arm of shoulder, elbow and wrist, with `change` applied to the elbow.
template <class Change>
Arm arm_with_elbow(Change change) {
  std::vector<Joint> joints{turning("shoulder"), turning("elbow"), turning("wrist")};
  change(joints[1]);
  return {"arm", joints};
}

TEST(Arm, HasTheGivenParts) {
  testing::Random random;
  const Pose tool = random.pose(), base = random.pose();
  const Arm arm("mine", {turning("a"), turning("b")}, tool, base);
  EXPECT_EQ(arm.name(), "mine");
  EXPECT_EQ(arm.dof(), 2);
  EXPECT_EQ(arm.joints().size(), 2);
  EXPECT_EQ(arm.tool().matrix(), tool.matrix());
  EXPECT_EQ(arm.base().matrix(), base.matrix());
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(arm.joint_of(1).name, "b");
  EXPECT_EQ(with_tool(arm, base).tool().matrix(), base.matrix());
  EXPECT_EQ(with_tool(arm, base).base().matrix(), base.matrix());
}

TEST(Arm, ATcpIsOnItsToolAndAMountBelowItsBase) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 6), 3);
    const Pose tcp = random.pose(), mount = random.pose(3);
    const Arm cell = with_mount(with_tcp(arm, tcp), mount);
    EXPECT_TRUE(cell.tool().isApprox(arm.tool() * tcp, 1e-14));
    EXPECT_TRUE(cell.base().isApprox(mount * arm.base(), 1e-14));
    EXPECT_EQ(cell.joint_names(), arm.joint_names());
    EXPECT_EQ(cell.name(), arm.name());
    const double radius = arm.reach().radius;
    EXPECT_NEAR(with_mount(arm, mount).reach().radius, radius, 1e-12 * (1 + radius));
  }
  Pose bent = Pose::Identity();
  bent.linear() *= 2;
  const Arm arm("arm", {turning("a")});
  EXPECT_REFUSED(with_tcp(arm, bent), "the tool centre point");
  EXPECT_REFUSED(with_mount(arm, bent), "the mount");
}

TEST(Arm, TheControllersFramesStayOnTheArm) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const Arm made = testing::random_arm(random, random.integer(1, 6), 3);
    EXPECT_TRUE(made.controller().base_assumed);
    EXPECT_TRUE(made.controller().base.matrix().isIdentity(0));
    EXPECT_EQ(made.controller().flange.matrix(), made.tool().matrix());
    const ControllerFrames frames{.base = random.pose(), .flange = random.pose()};
    const Arm arm(made.name(), made.joints(), made.tool(), made.base(), frames);
    const Pose tcp = random.pose(), mount = random.pose(3);
    const Arm cell = with_speed_scale(with_limits(with_mount(with_tcp(arm, tcp), mount), {}), 0.5);
    EXPECT_FALSE(cell.controller().base_assumed);
    EXPECT_EQ(cell.controller().flange.matrix(), frames.flange.matrix());
    // What does not depend on where the arm stands: link 0 in the root frame.
    EXPECT_TRUE((cell.controller().base.inverse() * cell.base())
                    .isApprox(frames.base.inverse() * arm.base(), 1e-13));
    EXPECT_EQ(with_tool(arm, tcp).controller().flange.matrix(), frames.flange.matrix());
  }
  EXPECT_REFUSED(Arm("a", {turning("j")}, Pose::Identity(), Pose::Identity(),
                     ControllerFrames{.base = make_pose({nan, 0, 0})}),
                 "the controller's base");
  EXPECT_REFUSED(Arm("a", {turning("j")}, Pose::Identity(), Pose::Identity(),
                     ControllerFrames{.flange = make_pose({2e6, 0, 0})}),
                 "the flange has the length 2e+06 m");
}

TEST(Arm, RefusesNoJointsAndDuplicateOrMissingNames) {
  EXPECT_REFUSED(Arm("empty", {}), "arm empty has no joints");
  EXPECT_REFUSED(arm_with_elbow([](Joint& j) { j.name = "wrist"; }), "two joints are called wrist");
  EXPECT_REFUSED(arm_with_elbow([](Joint& j) { j.name = ""; }), "joint 2 has no name");
}

TEST(Arm, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {nan, inf, -inf}) {
    EXPECT_REFUSED(arm_with_elbow([&](Joint& j) { j.offset.translation().x() = bad; }),
                   "joint 2 (elbow): the offset has a number that is not finite");
    EXPECT_REFUSED(arm_with_elbow([&](Joint& j) { j.offset.linear()(1, 2) = bad; }),
                   "joint 2 (elbow): the offset");
    EXPECT_REFUSED(arm_with_elbow([&](Joint& j) { j.screw[4] = bad; }),
                   "joint 2 (elbow) has a screw that is not finite");
    Pose pose = Pose::Identity();
    pose.translation().z() = bad;
    EXPECT_REFUSED(Arm("arm", {turning("a")}, pose), "the tool");
    EXPECT_REFUSED(Arm("arm", {turning("a")}, Pose::Identity(), pose), "the base");
  }
}

TEST(Arm, RefusesScrewsThatAreNotOfUnitLength) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const double size =
        random.integer(0, 1) == 0 ? random.uniform(0, 0.999) : random.uniform(1.001, 5);
    const auto kind = static_cast<JointKind>(i % 3);
    EXPECT_REFUSED(arm_with_elbow([&](Joint& j) {
                     j.screw = size * testing::random_joint(random, kind, "j").screw;
                   }),
                   "joint 2 (elbow) has a screw of length " + number(size));
  }
  EXPECT_REFUSED(arm_with_elbow([](Joint& j) { j.screw.setZero(); }), "length 0; it must be 1");
}

TEST(Arm, RefusesOffsetsThatAreNotRigidMotions) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    Pose stretched = random.pose(), mirrored = random.pose(), sheared = random.pose();
    stretched.linear() *= random.uniform(1.00001, 2);
    mirrored.linear().col(i % 3) *= -1;
    sheared.linear().col(i % 3) += 2e-6 * sheared.linear().col((i + 1) % 3);
    for (const Pose& bad : {stretched, mirrored, sheared}) {
      EXPECT_REFUSED(arm_with_elbow([&](Joint& j) { j.offset = bad; }),
                     "joint 2 (elbow): the offset is not a rigid motion");
      EXPECT_REFUSED(Arm("arm", {turning("a")}, bad), "the tool is not a rigid motion");
      EXPECT_REFUSED(Arm("arm", {turning("a")}, Pose::Identity(), bad),
                     "the base is not a rigid motion");
    }
  }
  Pose projective = Pose::Identity();
  projective.matrix()(3, 0) = 1;
  EXPECT_REFUSED(Arm("arm", {turning("a")}, projective), "last row");
}

TEST(Arm, RefusesInconsistentAndTooSmallLimits) {
  const auto with = [](Limits limits) {
    return arm_with_elbow([&](Joint& j) { j.limits = limits; });
  };
  EXPECT_REFUSED(with({.lower = 2, .upper = 1}),
                 "joint 2 (elbow): lower limit 2 exceeds upper limit 1");
  EXPECT_REFUSED(with({.lower = nan}), "joint 2 (elbow) has a position limit that is NaN");
  EXPECT_REFUSED(with({.upper = nan}), "joint 2 (elbow) has a position limit that is NaN");
  EXPECT_REFUSED(with({.lower = inf, .upper = inf}), "no finite value");
  EXPECT_REFUSED(with({.lower = -inf, .upper = -inf}), "no finite value");
  for (const double bad : {0.0, -1.0, nan, -inf, 1e-310, 9e-10}) {
    EXPECT_REFUSED(with({.velocity = bad}),
                   "joint 2 (elbow): velocity limit " + number(bad) + " is below 1e-09; omit it");
    EXPECT_REFUSED(with({.acceleration = bad}), "joint 2 (elbow): acceleration limit");
    EXPECT_REFUSED(with({.jerk = bad}), "joint 2 (elbow): jerk limit");
  }
  EXPECT_EQ(with({.velocity = Limits::min_rate}).limits(1).velocity, 1e-9);
  EXPECT_EQ(with({.lower = 1, .upper = 1}).limits(1).lower, 1) << "a held joint is allowed";
}

TEST(CheckConfiguration, RefusesWrongCountsAndNumbersThatAreNotFinite) {
  const Arm arm = built_in("rrr");
  EXPECT_REFUSED(check_configuration(arm, Configuration::Zero(2)),
                 "arm rrr takes 3 joint values (joint1, joint2, joint3), not 2");
  EXPECT_REFUSED(check_configuration(arm, Configuration::Zero(4)), "not 4");
  EXPECT_REFUSED(check_configuration(arm, Configuration()), "not 0");
  for (const double bad : {nan, inf, -inf}) {
    Configuration q = Configuration::Zero(3);
    q[1] = bad;
    EXPECT_REFUSED(check_configuration(arm, q), "the value of joint joint2 is " + number(bad));
  }
  EXPECT_NO_THROW(check_configuration(arm, Configuration::Constant(3, 1e300)));
}

TEST(LimitViolations, SayThatAnAngleIsRatherInDegrees) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    Joint turn = turning("turn");
    const double lower = random.uniform(-3, 0), upper = random.uniform(0.2, 3);
    turn.limits = {.lower = lower, .upper = upper};
    const Arm arm("arm", {turn});
    const double radians = random.uniform(lower, upper);
    const double degrees = radians * 180 / std::numbers::pi;
    const Configuration q{{degrees}};
    const std::vector<Reason> found = limit_violations(arm, q);
    if (found.empty()) continue;
    EXPECT_EQ(found.front().has(ReasonField::in_degrees), std::abs(degrees) > 2 * std::numbers::pi);
    const Configuration far{{(upper + 0.1) * 180 / std::numbers::pi}};  // outside in both units
    EXPECT_FALSE(limit_violations(arm, far).front().has(ReasonField::in_degrees));
  }
}

TEST(LimitViolations, NameTheJointItsValueAndItsLimits) {
  Joint slide;
  slide.name = "slide";
  slide.screw = translation_screw(Vector3::UnitX());
  slide.limits = {.lower = 0, .upper = 0.5};
  Joint turn = turning("turn");
  turn.limits = {.lower = -1, .upper = 1};
  const Arm arm("arm", {turn, slide, turning("free")});
  EXPECT_TRUE(limit_violations(arm, Eigen::Vector3d(1, 0.5, 1e6)).empty());
  EXPECT_TRUE(limit_violations(arm, Eigen::Vector3d(1 + 1e-10, -1e-10, 0)).empty());
  EXPECT_EQ(limit_violations(arm, Eigen::Vector3d(1 + 1e-10, -1e-10, 0), 0).size(), 2);
  const std::vector<Reason> found = limit_violations(arm, Eigen::Vector3d(-1.5, 0.75, 0));
  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(testing::joint(found[0]), "turn");
  EXPECT_EQ(testing::field<double>(found[0], ReasonField::value), -1.5);
  EXPECT_EQ(testing::field<double>(found[0], ReasonField::lower), -1.0);
  EXPECT_EQ(testing::joint(found[1]), "slide");
  EXPECT_EQ(testing::field<std::string>(found[1], ReasonField::unit), "m");
  EXPECT_FALSE(found[0].has(ReasonField::in_degrees));
  EXPECT_REFUSED(limit_violations(arm, Configuration::Zero(2)), "takes 3 joint values");
}

TEST(Arm, RefusesNumbersWithoutPhysicalSense) {
  const auto refused = [](auto change) {
    Joint joint = turning("j");
    change(joint);
    return testing::refusal([&] { Arm("arm", {joint}); });
  };
  const std::string accepted = "accepted";
  EXPECT_EQ(refused([](Joint& j) { j.offset.translation().x() = 1e6; }), accepted);
  EXPECT_EQ(refused([](Joint& j) { j.offset.translation().x() = -2e6; }),
            "joint 1 (j): the offset has the length 2e+06 m; accepted are -1e+06 to 1e+06 m");
  EXPECT_EQ(refused([](Joint& j) { j.limits.upper = 1e12; }),
            "joint 1 (j): position limit 1e+12 is outside -1e+06 to 1e+06 rad or m; omit it if "
            "there is no limit");
  EXPECT_EQ(refused([](Joint& j) { j.limits.jerk = 1e300; }),
            "joint 1 (j): jerk limit 1e+300 is above 1e+10; omit it if there is no limit");
  EXPECT_EQ(refused([](Joint& j) { j.limits.velocity = 1e10; }), accepted);
  EXPECT_REFUSED(Arm("arm", {turning("j")}, make_pose({0, 0, 1e7})), "the tool has the length");
  EXPECT_REFUSED(with_mount(Arm("arm", {turning("j")}), make_pose({1e7, 0, 0})), "the base has");
  std::vector<Joint> joints;
  for (int i = 0; i < 101; ++i) joints.push_back(turning("j" + std::to_string(i)));
  EXPECT_REFUSED(Arm("arm", joints), "arm arm has 101 joints; at most 100 are accepted");
}

TEST(MiddleConfiguration, IsTheMiddleOrElseTheValueNearestToZero) {
  const auto middle = [](double lower, double upper) {
    Joint joint = turning("j");
    joint.limits = {.lower = lower, .upper = upper};
    return middle_configuration(Arm("arm", {joint}))[0];
  };
  EXPECT_EQ(middle(-1, 3), 1);
  EXPECT_EQ(middle(-inf, inf), 0);
  EXPECT_EQ(middle(2, inf), 2);
  EXPECT_EQ(middle(-2, inf), 0);
  EXPECT_EQ(middle(-inf, -3), -3);
  EXPECT_EQ(middle(0.7e6, 0.9e6), 0.8e6);
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    EXPECT_TRUE(limit_violations(arm, middle_configuration(arm), 0).empty()) << name;
  }
}

TEST(RandomConfiguration, IsUniformWithinTheLimits) {
  const Limits limits[] = {{-1, 3}, {-inf, 2}, {5, inf}, {}, {1, 1}};
  std::vector<Joint> joints;
  for (const Limits& of_joint : limits) {
    joints.push_back(turning("j" + std::to_string(joints.size())));
    joints.back().limits = of_joint;
  }
  const Arm arm("arm", joints);
  const double ranges[][2] = {{-1, 3},
                              {2 - 2 * std::numbers::pi, 2},
                              {5, 5 + 2 * std::numbers::pi},
                              {-std::numbers::pi, std::numbers::pi},
                              {1, 1}};
  std::mt19937_64 engine(7), again(7), other(8);
  constexpr int count = 4000;
  Configuration mean = Configuration::Zero(arm.dof());
  for (int i = 0; i < count; ++i) {
    const Configuration q = random_configuration(arm, engine);
    ASSERT_EQ(q, random_configuration(arm, again));
    for (int k = 0; k < arm.dof(); ++k) {
      ASSERT_GE(q[k], ranges[k][0]);
      ASSERT_LE(q[k], ranges[k][1]);
    }
    mean += q / count;
  }
  for (int k = 0; k < arm.dof(); ++k) {
    const double width = ranges[k][1] - ranges[k][0];  // the mean has a deviation of 0.0046 widths
    EXPECT_NEAR(mean[k], (ranges[k][0] + ranges[k][1]) / 2, 0.03 * width + 1e-12);
  }
  EXPECT_NE(random_configuration(arm, engine), random_configuration(arm, other));
}

TEST(OutsideLimits, ListsTheCoordinatesBeyondTheSlack) {
  const Arm arm = built_in("panda");
  Configuration q = middle_configuration(arm);
  EXPECT_TRUE(outside_limits(arm, q).empty());
  q[1] = arm.limits(1).upper + 1e-8;
  q[3] = arm.limits(3).lower - 1e-10;
  EXPECT_EQ(outside_limits(arm, q), std::vector<int>{1});
  EXPECT_EQ(outside_limits(arm, q, 0), (std::vector<int>{1, 3}));
}

TEST(LimitMargin, IsOneInTheMiddleAndZeroAtTheLimits) {
  EXPECT_EQ(limit_margin(2, 1, 3), 1);
  EXPECT_EQ(limit_margin(1.5, 1, 3), 0.5);
  EXPECT_EQ(limit_margin(3, 1, 3), 0);
  EXPECT_EQ(limit_margin(4, 1, 3), -1);
  EXPECT_EQ(limit_margin(0, -inf, 3), inf);
  EXPECT_EQ(limit_margin(1, 1, 1), inf);
  EXPECT_EQ(position_in_range(1.5, 1, 3), -0.5);
  EXPECT_EQ(position_in_range(1.5, 1, inf), 0);
}

TEST(Arm, PrintsItsJointsLimitsFramesAndReach) {
  std::ostringstream out;
  const Arm arm = arm_with_elbow([](Joint& joint) {
    joint.limits = {.lower = -1, .upper = 2, .velocity = 3};
    joint.link = "forearm";
  });
  out << arm;
  EXPECT_EQ(out.str(), arm_table(arm));
  for (const char* line :
       {"arm: 3 joints, 3 degrees of freedom, planar\n",
        "  2  elbow     revolute   0, 0, 1                        -1          2           3  "
        "          12 a         120 a\n",
        "  (a: not known, assumed in motions)\n", "  2 forearm                 0, 0, 0  ",
        "  tool  ", "\nreach: the tool stays within 0 m of the point 0, 0, 0\n"}) {
    EXPECT_NE(out.str().find(line), std::string::npos) << line << out.str();
  }
  EXPECT_NE(arm_table(arm, true).find("  -57.2958    114.592     171.887  "), std::string::npos);
  out.str("");
  out << JointKind::prismatic;
  EXPECT_EQ(out.str(), "prismatic");
}

}  // namespace
}  // namespace beeline
