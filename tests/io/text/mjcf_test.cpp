#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/urdf.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include <tests/io/text/mjcf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Arms of MJCF files. tests/peers/mjcf_test.py compares their kinematics with MuJoCo's.

namespace beeline {
namespace {

using testing::mujoco;

constexpr double degree = std::numbers::pi / 180;

Arm parse_mjcf(const std::string& text, const ChainEnds& ends = {}) {
  return arm_from_urdf(text, "a.xml", ends);
}

Vector3 tool_position(const Arm& arm, const std::vector<double>& q) {
  Configuration values(arm.dof());
  for (int i = 0; i < arm.dof(); ++i) values[i] = q[static_cast<std::size_t>(i)];
  return forward_kinematics(arm, values).translation();
}

/// A body with one joint, and a site 1 m along x.
std::string hinge(const std::string& attributes) {
  return "<body name=\"a\"><joint name=\"j\" " + attributes +
         "/><geom size=\"0.1\"/><site name=\"end\" pos=\"1 0 0\"/></body>\n";
}

TEST(Mjcf, JointsNamesAndLimitsAreTheFiles) {
  const Arm arm = parse_mjcf(testing::whole_mjcf, {.tip = "left"});
  EXPECT_EQ(arm.name(), "small arm");
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"pan", "lift", "left_finger"}));
  ASSERT_EQ(arm.joints().size(), 3u);
  EXPECT_EQ(arm.joints()[0].limits.lower, -Limits::none);
  EXPECT_EQ(arm.joints()[1].limits.upper, 2);
  EXPECT_EQ(kind(arm.joints()[2]), JointKind::prismatic);
  EXPECT_EQ(arm.joints()[2].limits.upper, 0.04);
  EXPECT_EQ(arm.joints()[1].link, "upper");
  EXPECT_EQ(arm.joints()[1].limits.velocity, Limits::none);
}

TEST(Mjcf, AnglesAreInDegreesUnlessTheCompilerSaysRadian) {
  for (const bool radians : {false, true}) {
    const double unit = radians ? 1 : degree;
    const Arm arm = parse_mjcf(
        mujoco(hinge("range=\"-1 1.5\""), radians ? "<compiler angle=\"radian\"/>" : ""));
    EXPECT_DOUBLE_EQ(arm.joints()[0].limits.lower, -unit);
    EXPECT_DOUBLE_EQ(arm.joints()[0].limits.upper, 1.5 * unit);
  }
}

TEST(Mjcf, AtTheRefTheBodyIsAtItsPose) {
  const Arm arm = parse_mjcf(mujoco(hinge("ref=\"30\" range=\"0 90\"")), {.tip = "end"});
  EXPECT_LT((tool_position(arm, {30 * degree}) - Vector3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((tool_position(arm, {120 * degree}) - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(arm.joints()[0].limits.upper, 90 * degree);
}

TEST(Mjcf, TheAxisPassesThroughThePositionOfTheJoint) {
  const Arm arm = parse_mjcf(mujoco(hinge("pos=\"2 0 0\"")), {.tip = "end"});
  EXPECT_LT((tool_position(arm, {90 * degree}) - Vector3(2, -1, 0)).norm(), 1e-15);
}

TEST(Mjcf, JointsOfOneBodyFollowEachOther) {
  const Arm arm = parse_mjcf(
      mujoco("<body name=\"a\"><joint name=\"x\" type=\"slide\" axis=\"2 0 0\"/><joint "
             "name=\"t\"/><geom size=\"0.1\"/><site name=\"end\" pos=\"0 1 0\"/></body>\n"),
      {.tip = "end"});
  ASSERT_EQ(arm.dof(), 2);
  EXPECT_EQ(arm.joints()[0].link, "a.1");
  EXPECT_EQ(arm.joints()[1].link, "a");
  EXPECT_LT((tool_position(arm, {3, 90 * degree}) - Vector3(2, 0, 0)).norm(), 1e-15);
}

TEST(Mjcf, ARangeLimitsUnlessTheFileSaysOtherwise) {
  const auto upper = [](const std::string& attributes, const std::string& compiler = "") {
    return parse_mjcf(mujoco(hinge("type=\"slide\" " + attributes), compiler))
        .joints()[0]
        .limits.upper;
  };
  EXPECT_EQ(upper("range=\"0 2\""), 2);
  EXPECT_EQ(upper("range=\"0 2\" limited=\"auto\""), 2);
  EXPECT_EQ(upper("range=\"0 2\" limited=\"false\""), Limits::none);
  EXPECT_EQ(upper("range=\"0 0\""), Limits::none);
  const std::string off = "<compiler autolimits=\"false\"/>";
  EXPECT_EQ(upper("range=\"0 2\" limited=\"true\"", off), 2);
  EXPECT_REFUSED(upper("range=\"0 2\"", off), "a.xml:3: <joint>: range is given without limited");
  EXPECT_REFUSED(upper("limited=\"true\""), "a.xml:3: <joint>: range must have");
}

// In MuJoCo 4.0 jnt_limited is 0 then.
TEST(Mjcf, ARangeThatIsReversedOrEmptyIsNoneWithAWarning) {
  for (const char* const range : {"1 -1", "0 -1", "1 1"}) {
    std::vector<ReadWarning> warnings;
    const std::string attribute = "range=\"" + std::string(range) + "\"";
    const Arm arm = arm_from_urdf(mujoco(hinge(attribute)), "a.xml", {}, &warnings);
    EXPECT_EQ(arm.limits(0).lower, -Limits::none) << range;
    EXPECT_EQ(arm.limits(0).upper, Limits::none) << range;
    ASSERT_EQ(warnings.size(), 1u) << range;
    EXPECT_EQ(warnings[0].kind, ReadWarningKind::range_ignored);
    EXPECT_EQ(warnings[0].joint, "j");
    EXPECT_EQ(warnings[0].line, 3);
    EXPECT_EQ(warnings[0].numbers.size(), 2u);
    EXPECT_REFUSED(parse_mjcf(mujoco(hinge(attribute + " limited=\"true\""))), "range must have");
    EXPECT_EQ(parse_mjcf(mujoco(hinge(attribute + " limited=\"false\""))).dof(), 1);
  }
}

TEST(Mjcf, ALimitBeyondTheRangeOfLimitsIsNone) {
  const Arm arm = parse_mjcf(mujoco(hinge("type=\"slide\" range=\"-1e9 2\"")));
  EXPECT_EQ(arm.limits(0).lower, -Limits::none);
  EXPECT_EQ(arm.limits(0).upper, 2);
  EXPECT_EQ(kind(arm.joints()[0]), JointKind::prismatic);
}

TEST(Mjcf, OtherConstraintsThatAreActiveAreNamed) {
  const std::string bodies = "<body name=\"a\"><joint name=\"a\"/></body>\n";
  std::vector<ReadWarning> warnings;
  arm_from_urdf(mujoco(bodies,
                       "<default><default class=\"off\"><equality active=\"false\"/></default>"
                       "</default><equality>\n<connect name=\"loop\" body1=\"a\" "
                       "anchor=\"0 0 0\"/><weld body1=\"a\" active=\"false\"/><weld "
                       "class=\"off\" body1=\"a\"/>\n<weld body1=\"a\" body2=\"b\"/></equality>"),
                "a.xml", {}, &warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].kind, ReadWarningKind::constraint_ignored);
  EXPECT_EQ(warnings[0].element, "<connect>");
  EXPECT_EQ(warnings[0].value, "loop");
  EXPECT_EQ(warnings[0].line, 2);
  EXPECT_EQ(warnings[1].element, "<weld>");
  EXPECT_EQ(warnings[1].others, (std::vector<std::string>{"a", "b"}));
  EXPECT_NE(sentence(warnings[0]).find("a.xml:2: the equality constraint <connect> \"loop\" of a"),
            std::string::npos)
      << sentence(warnings[0]);
}

TEST(Mjcf, EqualityConstraintsOfJointsAreMimicJoints) {
  const std::string bodies =
      "<body name=\"a\"><joint name=\"a\" ref=\"90\"/><body name=\"b\"><joint name=\"b\" "
      "ref=\"180\"/><body name=\"c\"><joint name=\"c\"/></body></body></body>\n";
  const std::string front = "<equality><joint joint1=\"b\" joint2=\"a\" polycoef=\"0.5 2";
  const Arm arm = parse_mjcf(mujoco(bodies, front + "\"/></equality>"));
  ASSERT_EQ(arm.joint_names(), (std::vector<std::string>{"a", "c"}));
  ASSERT_TRUE(arm.joints()[1].mimic);
  EXPECT_EQ(arm.joints()[1].mimic->leader, "a");
  EXPECT_EQ(arm.joints()[1].mimic->multiplier, 2);
  EXPECT_NEAR(arm.joints()[1].mimic->offset, 0.5, 1e-15);  // 180 + 0.5 rad - 2 * 90
  EXPECT_EQ(parse_mjcf(mujoco(bodies, front + "\" active=\"false\"/></equality>")).dof(), 3);
  EXPECT_EQ(parse_mjcf(mujoco(bodies, "<equality><joint joint1=\"b\"/></equality>")).dof(), 2);
  const std::string curved = mujoco(bodies, front + " 0.1\"/></equality>");
  EXPECT_REFUSED(parse_mjcf(curved), "a.xml:1: joint b follows joint a by a polycoef");
  std::vector<ReadWarning> warnings;
  EXPECT_EQ(arm_from_urdf(curved, "a.xml", {.tip = "a"}, &warnings).dof(), 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, ReadWarningKind::nonlinear_coupling);
}

TEST(Mjcf, FreeAndBallJointsAreRefusedOnTheChainAlone) {
  const std::string bodies =
      "<body name=\"cube\"><freejoint/></body>\n<body name=\"p\"><joint name=\"s\" "
      "type=\"ball\"/>\n<body name=\"q\"><joint name=\"k\"/></body></body>\n<body "
      "name=\"a\"><joint name=\"j\"/></body>\n";
  EXPECT_EQ(parse_mjcf(mujoco(bodies), {.tip = "a"}).dof(), 1);
  EXPECT_REFUSED(parse_mjcf(mujoco(bodies), {.tip = "q"}),
                 "a.xml:4: joint s is \"ball\"; a chain has hinge and slide joints");
  EXPECT_REFUSED(parse_mjcf(mujoco(bodies), {.base = "world", .tip = "cube"}),
                 "a.xml:3: joint joint0 is \"free\"; a chain has hinge and slide joints");
}

TEST(Mjcf, ARobotOnAFreeBaseBeginsBelowIt) {
  std::vector<ReadWarning> warnings;
  const Arm arm = arm_from_urdf(
      mujoco("<body name=\"t\"><freejoint name=\"root\"/><body name=\"a\"><joint name=\"j\"/>"
             "</body></body>\n"),
      "a.xml", {}, &warnings);
  EXPECT_EQ(arm.dof(), 1);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].kind, ReadWarningKind::below_free_joint);
}

// The axes are MuJoCo's.
TEST(Mjcf, AClassKeepsWhatMainHadWhenItBegan) {
  const std::string text =
      "<mujoco><default><joint axis=\"0 1 0\"/><default class=\"x\"/>"
      "<default class=\"w\"><joint axis=\"0 0 1\"/></default></default>"
      "<default><joint axis=\"1 0 0\"/><default class=\"y\"/></default>"
      "<worldbody><body><joint class=\"x\"/><body><joint/><body><joint class=\"y\"/>"
      "<body><joint class=\"w\"/></body></body></body></body></worldbody></mujoco>";
  const Arm arm = parse_mjcf(text);
  const std::vector<Vector3> axes{Vector3::UnitY(), Vector3::UnitX(), Vector3::UnitX(),
                                  Vector3::UnitZ()};
  ASSERT_EQ(arm.dof(), 4);
  const Jacobian columns = jacobian(arm, Configuration::Zero(4));
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(columns.col(k).tail<3>().isApprox(axes[k], 1e-15)) << k;
  std::string many = "<mujoco>";
  for (int i = 0; i < 200; ++i) {
    many +=
        "<default><joint axis=\"1 0 0\"/><default class=\"c" + std::to_string(i) + "\"/></default>";
  }
  many += "<worldbody><body><joint/></body></worldbody></mujoco>";
  EXPECT_REFUSED(parse_mjcf(many), "more than 100 times");
}

// A nested class replaces the orientation of the class around it in whatever form it gives it.
TEST(Mjcf, TheInnermostClassGivesTheOrientation) {
  const std::vector<std::string> turned{
      // a quarter turn about z
      "euler=\"0 0 90\"", "axisangle=\"0 0 1 90\"", "xyaxes=\"0 1 0 -1 0 0\"", "quat=\"1 0 0 1\""};
  const std::vector<std::string> level{"euler=\"0 0 0\"", "axisangle=\"0 0 1 0\"",
                                       "xyaxes=\"1 0 0 0 1 0\"", "quat=\"1 0 0 0\"",
                                       "zaxis=\"0 0 1\""};
  for (const std::string& outer : turned) {
    for (const std::string& inner : level) {
      const auto tool = [&](const std::string& nested, const std::string& own) -> Rotation {
        const std::string text =
            "<mujoco><default><site " + outer + "/><default class=\"c\">" + nested +
            "</default></default><worldbody><body><joint/><site name=\"s\" class=\"c\" " + own +
            "/></body></worldbody></mujoco>";
        return parse_mjcf(text, {.tip = "s"}).tool().linear();
      };
      const std::string site = "<site " + inner + "/>";
      EXPECT_TRUE(tool("", "").col(0).isApprox(Vector3::UnitY(), 1e-15)) << outer;
      EXPECT_TRUE(tool(site, "").isIdentity(1e-15)) << outer << ", " << inner;
      EXPECT_TRUE(tool("", inner).isIdentity(1e-15)) << outer << ", " << inner;
      const std::string earlier = "<site " + outer + "/>";  // of the same class
      EXPECT_TRUE(tool(earlier + site, "").isIdentity(1e-15)) << outer << ", " << inner;
    }
  }
}

TEST(Mjcf, SitesAreTipsThatAreNamed) {
  const std::string one = mujoco(hinge(""));
  EXPECT_EQ(parse_mjcf(one).tool().translation().x(), 0);
  EXPECT_EQ(parse_mjcf(one, {.tip = "end"}).tool().translation().x(), 1);
  EXPECT_REFUSED(parse_mjcf(one, {.tip = "ende"}),
                 "unknown tip link \"ende\"; did you mean \"end\"?");
  const std::string same = mujoco(
      "<body name=\"a\"><joint/><site name=\"a\" pos=\"1 0 0\"/><site pos=\"2 0 0\"/></body>\n");
  EXPECT_EQ(parse_mjcf(same, {.tip = "a"}).tool().translation().x(), 0);
  EXPECT_EQ(parse_mjcf(same, {.tip = "a_"}).tool().translation().x(), 1);
}

TEST(Mjcf, SeveralTipsAreListed) {
  EXPECT_REFUSED(parse_mjcf(testing::whole_mjcf),
                 "a.xml: has 2 tips below world; choose one as the tip: left, right");
}

TEST(Mjcf, BodiesAndJointsWithoutNamesHaveTheirNumbers) {
  const Arm arm = parse_mjcf(mujoco("<body><joint/><body><joint/></body></body>\n"));
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"joint0", "joint1"}));
  EXPECT_EQ(arm.joints()[1].link, "body2");
  const Arm taken =
      parse_mjcf(mujoco("<body name=\"body2\"><joint name=\"joint1\"/><body>"
                        "<joint/></body></body>\n"));
  EXPECT_EQ(taken.joint_names(), (std::vector<std::string>{"joint1", "joint1_"}));
  EXPECT_EQ(taken.joints()[1].link, "body2_");
}

TEST(Mjcf, TheRootElementDecidesTheFormat) {
  const testing::TemporaryFolder folder;
  const std::string mjcf = mujoco(hinge(""));
  const std::string urdf =
      "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" "
      "type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>";
  for (const char* const name : {"a.xml", "a.mjcf", "a.urdf"}) {
    EXPECT_EQ(read_arm(folder.write(name, "<?xml version=\"1.0\"?><!-- <robot> -->" + mjcf)).name(),
              "m");
    EXPECT_EQ(read_arm(folder.write(name, "<!-- <mujoco> -->" + urdf)).name(), "r");
  }
  EXPECT_REFUSED(parse_mjcf("<mujocoinclude/>"), "a.xml:1: is a part of an MJCF model");
}

}  // namespace
}  // namespace beeline
