#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/model/arm.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;

/// The motion of the composite's joints in their order.
Pose motion(const std::vector<Joint>& joints, const std::vector<double>& q) {
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < joints.size(); ++i) pose = pose * joint_transform(joints[i], q[i]);
  return pose;
}

std::string letters(const std::vector<Joint>& joints) {
  std::string text;
  for (const Joint& joint : joints) text += letter(kind(joint));
  return text;
}

std::vector<std::string> names(char letter) {
  return Arm("a", composite_joint(letter, "j")).joint_names();
}

void expect_pose(const Pose& pose, const Vector3& position, const Rotation& turn) {
  ASSERT_LT((pose.matrix() - make_pose(position, turn).matrix()).norm(), 9e-15);
}

TEST(CompositeJoint, ExpandsIntoOneDegreeOfFreedomJointsWithCoincidentFrames) {
  EXPECT_EQ(letters(composite_joint('R', "j")), "R");
  EXPECT_EQ(letters(composite_joint('P', "j")), "P");
  EXPECT_EQ(letters(composite_joint('H', "j", 0.1)), "H");
  EXPECT_EQ(letters(composite_joint('S', "j")), "RRR");
  EXPECT_EQ(letters(composite_joint('U', "j")), "RR");
  EXPECT_EQ(letters(composite_joint('C', "j")), "RP");
  EXPECT_EQ(letters(composite_joint('E', "j")), "PPR");
  for (const char letter : std::string("RPHSUCE")) {
    for (const Joint& joint : composite_joint(letter, "j", 0.1)) {
      EXPECT_EQ(joint.offset.matrix(), Pose::Identity().matrix()) << letter;
    }
  }
}

TEST(CompositeJoint, NamesItsJointsByAxis) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names('R'), (Names{"j"}));
  EXPECT_EQ(names('P'), (Names{"j"}));
  EXPECT_EQ(names('S'), (Names{"j_z", "j_y", "j_x"}));
  EXPECT_EQ(names('U'), (Names{"j_z", "j_y"}));
  EXPECT_EQ(names('C'), (Names{"j_z", "j_slide_z"}));
  EXPECT_EQ(names('E'), (Names{"j_slide_x", "j_slide_y", "j_z"}));
}

TEST(CompositeJoint, IsActuatedInTheOrderThatTheHeaderGives) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3), c = random.uniform(-3, 3);
    const Rotation about_z = rotation({0, 0, a});
    expect_pose(motion(composite_joint('R', "j"), {a}), {0, 0, 0}, about_z);
    expect_pose(motion(composite_joint('P', "j"), {a}), {a, 0, 0}, Rotation::Identity());
    expect_pose(motion(composite_joint('H', "j", b), {a}), {0, 0, a * b}, about_z);
    expect_pose(motion(composite_joint('S', "j"), {a, b, c}), {0, 0, 0}, rotation({c, b, a}));
    expect_pose(motion(composite_joint('U', "j"), {a, b}), {0, 0, 0}, rotation({0, b, a}));
    expect_pose(motion(composite_joint('C', "j"), {a, b}), {0, 0, b}, about_z);
    expect_pose(motion(composite_joint('E', "j"), {b, c, a}), {b, c, 0}, about_z);
  }
}

TEST(CompositeJoint, SphericalReachesEveryOrientationAndPlanarEveryPlanarPose) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Rotation wanted = random.rotation();
    const RollPitchYaw rpy = roll_pitch_yaw(wanted);
    expect_pose(motion(composite_joint('S', "j"), {rpy.yaw, rpy.pitch, rpy.roll}), {0, 0, 0},
                wanted);
    const Pose2 pose{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-pi, pi)};
    const Pose reached = motion(composite_joint('E', "j"), {pose.x, pose.y, pose.theta});
    ASSERT_LT((reached.matrix() - to_space(pose).matrix()).norm(), 3e-15);
  }
}

TEST(CompositeJoint, RefusesOtherLettersNamingTheKnown) {
  EXPECT_REFUSED(composite_joint('X', "j"), "unknown joint type \"X\"");
  EXPECT_REFUSED(composite_joint('X', "j"), "R, P, H, S, C, E, U");
  EXPECT_REFUSED(composite_joint('r', "j"), "did you mean \"R\"?");
  EXPECT_REFUSED(composite_joint('\n', "j"), "unknown joint type");
  EXPECT_REFUSED(composite_joint('\0', "j"), "unknown joint type");
}

}  // namespace
}  // namespace beeline
