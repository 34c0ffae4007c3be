#include <gtest/gtest.h>
#include <numbers>

#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;

void expect_same_joints(const Arm& a, const Arm& b) {
  ASSERT_EQ(a.joints().size(), b.joints().size());
  for (std::size_t i = 0; i < a.joints().size(); ++i) {
    EXPECT_EQ(a.joints()[i].name, b.joints()[i].name);
    EXPECT_EQ(a.joints()[i].screw, b.joints()[i].screw) << i;
    EXPECT_LT((a.joints()[i].offset.matrix() - b.joints()[i].offset.matrix()).norm(), 1e-15) << i;
  }
}

TEST(JointString, NamesTheChaptersArms) {
  expect_same_joints(arm_from_joint_string("RRR:3.5,3.5,2"), built_in("rrr"));
  expect_same_joints(arm_from_joint_string("RP"), built_in("rp"));
  expect_same_joints(arm_from_joint_string("PP:0,0@90"), built_in("gantry"));
  EXPECT_EQ(arm_from_joint_string("RRR:3.5,3.5,2").name(), "RRR:3.5,3.5,2");
}

/// The chapter's eq. 1.2 with a prismatic joint and a fixed angle, by angles and lengths in the
/// plane.
TEST(JointString, PlanarArmsGoWhereTrigonometrySays) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2), c = random.uniform(-2, 2);
    const double bend = random.uniform(-180, 180);
    const Arm arm = arm_from_joint_string("RPR:" + std::to_string(a) + "," + std::to_string(b) +
                                          "@" + std::to_string(bend) + "," + std::to_string(c));
    const double length[] = {std::stod(std::to_string(a)), std::stod(std::to_string(b)),
                             std::stod(std::to_string(c))};
    const double turn = std::stod(std::to_string(bend)) * pi / 180;
    const Configuration q = random.configuration(arm);
    const double slide = q[0] + turn;
    const double last = slide + q[2];
    const Pose pose = forward_kinematics(arm, q);
    EXPECT_NEAR(pose.translation().x(),
                length[0] * std::cos(q[0]) + (q[1] + length[1]) * std::cos(slide) +
                    length[2] * std::cos(last),
                1e-12);
    EXPECT_NEAR(pose.translation().y(),
                length[0] * std::sin(q[0]) + (q[1] + length[1]) * std::sin(slide) +
                    length[2] * std::sin(last),
                1e-12);
    EXPECT_NEAR(std::remainder(std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)) - last, 2 * pi),
                0, 1e-12);
    EXPECT_TRUE(arm.planar());
  }
}

TEST(JointString, DefaultLengthsAreOneButNotForSlides) {
  const Arm arm = arm_from_joint_string("RPR");
  const Pose rest_pose = forward_kinematics(arm, Configuration::Zero(3));
  EXPECT_TRUE(rest_pose.translation().isApprox(Vector3(2, 0, 0), 1e-15));
}

TEST(JointString, CompositesRotateFirstAndExtendLast) {
  const Arm arm = arm_from_joint_string("RS:1,2@90");
  ASSERT_EQ(arm.dof(), 4);
  EXPECT_EQ(arm.joint_names(),
            (std::vector<std::string>{"joint1", "joint2_z", "joint2_y", "joint2_x"}));
  const Pose rest = forward_kinematics(arm, Configuration::Zero(4));
  EXPECT_TRUE(rest.translation().isApprox(Vector3(1, 2, 0), 1e-15));
  // The y axis of the rotated wrist is the base's -x: a rotation about it by 90 degrees moves the
  // arm's end from +y to... Rz(90) Ry(90) x = Rz(90) (-z) = -z.
  Configuration q = Configuration::Zero(4);
  q[2] = pi / 2;
  EXPECT_TRUE(forward_kinematics(arm, q).translation().isApprox(Vector3(1, 0, -2), 1e-15));
  EXPECT_EQ(arm_from_joint_string("SCEU").dof(), 3 + 2 + 3 + 2);
}

TEST(JointString, PitchIsTravelPerRevolution) {
  const Arm arm = arm_from_joint_string("H:0.5p0.05");
  const Pose turned = forward_kinematics(arm, Configuration::Constant(1, 2 * pi));
  EXPECT_TRUE(turned.translation().isApprox(Vector3(0.5, 0, 0.05), 1e-14));
  const Pose half =
      forward_kinematics(arm_from_joint_string("H:1@90p-2"), Configuration::Constant(1, pi));
  EXPECT_TRUE(half.translation().isApprox(Vector3(0, -1, -1), 1e-14));
  const Pose plain =
      forward_kinematics(arm_from_joint_string("H"), Configuration::Constant(1, 2 * pi));
  EXPECT_TRUE(plain.translation().isApprox(Vector3(1, 0, 1), 1e-14));
}

TEST(JointString, IsDistinguishedFromOtherWords) {
  for (const char* text : {"R", "RRR", "RRR:1,2,3", "CUE", "RXR:1,1,1", "SCEU:", "P:"}) {
    EXPECT_TRUE(is_joint_string(text)) << text;
  }
  for (const char* text :
       {"", "rrr", "RrR", "RXR", "R R", "panda", "RRR.urdf", ":1", "ur5:1", "R1"}) {
    EXPECT_FALSE(is_joint_string(text)) << text;
  }
}

TEST(JointString, MistakesAreNamed) {
  EXPECT_REFUSED(arm_from_joint_string("RRR:1,2"),
                 "RRR has 3 letters but 2 items; give one length for each letter");
  EXPECT_REFUSED(arm_from_joint_string("RR:1,2,3"), "2 letters but 3 items");
  EXPECT_REFUSED(arm_from_joint_string("R:"), "length: a number is missing");
  EXPECT_REFUSED(arm_from_joint_string("RXR:1,1,1"),
                 "unknown joint type \"X\" (known: R, P, H, S, C, E, U)");
  EXPECT_REFUSED(arm_from_joint_string("RR:1,x"), "item 2 \"x\", length: \"x\" is not a number");
  EXPECT_REFUSED(arm_from_joint_string("RR:1,2@"), "item 2 \"2@\", angle: a number is missing");
  EXPECT_REFUSED(arm_from_joint_string("H:1pq"), "item 1 \"1pq\", pitch: \"q\" is not a number");
  EXPECT_REFUSED(arm_from_joint_string("R:1p2"), "gives a pitch to R; only H");
  EXPECT_REFUSED(arm_from_joint_string("H:1p0"), "pitch of 0; use R");
  EXPECT_REFUSED(arm_from_joint_string("R:nan"), "must be finite");
  EXPECT_REFUSED(arm_from_joint_string(":1"), "begins with its letters");
}

TEST(JointString, AHundredLettersWorkAndMoreAreRefused) {
  const Arm arm = arm_from_joint_string(std::string(100, 'R'));
  EXPECT_EQ(arm.dof(), 100);
  EXPECT_EQ(forward_kinematics(arm, Configuration::Zero(100)).translation(), Vector3(100, 0, 0));
  EXPECT_REFUSED(arm_from_joint_string(std::string(101, 'R')),
                 "has 101 letters; at most 100 are accepted");
  EXPECT_REFUSED(arm_from_joint_string(std::string(std::size_t{1} << 20, 'S') + ":1"), "at most");
}

}  // namespace
}  // namespace beeline
