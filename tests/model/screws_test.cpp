#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr ScrewFrame frames[] = {ScrewFrame::space, ScrewFrame::body};

/// A random rotation, translation or, at times, helical screw.
Twist random_screw(testing::Random& random) {
  Vector3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  axis.normalize();
  const double kind = random.uniform(0, 1);
  if (kind < 0.2) return translation_screw(axis);
  const Vector3 point(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return rotation_screw(axis, point, kind < 0.3 ? random.uniform(0.01, 0.2) : 0);
}

TEST(Screws, AnArmOfScrewsIsTheProductOfTheirExponentials) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Pose home = random.pose();
    std::vector<Twist> screws;
    for (int k = 0; k < 1 + i % 8; ++k) screws.push_back(random_screw(random));
    const Arm space = arm_from_screws("a", screws, home, ScrewFrame::space);
    const Arm body = arm_from_screws("a", screws, home, ScrewFrame::body);
    Configuration q(static_cast<Eigen::Index>(screws.size()));
    for (double& value : q) value = random.uniform(-3, 3);
    Pose motion = Pose::Identity();
    for (std::size_t k = 0; k < screws.size(); ++k) {
      motion = motion * screw_motion(screws[k], q[static_cast<Eigen::Index>(k)]);
    }
    const auto differs = [&](const Arm& arm, const Pose& expected) {
      return (forward_kinematics(arm, q).matrix() - expected.matrix()).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(differs(space, motion * home), 1e-12) << i;
    EXPECT_LT(differs(body, home * motion), 1e-12) << i;
  }
}

TEST(Screws, ReadBackAsTheSameArm) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    if (static_cast<std::size_t>(arm.dof()) != arm.joints().size()) continue;  // mimic joints
    for (const ScrewFrame frame : frames) {
      const Arm again = arm_from_screws(name, screws(arm, frame), home_pose(arm), frame);
      ASSERT_EQ(again.dof(), arm.dof());
      for (int k = 0; k < arm.dof(); ++k) {
        EXPECT_EQ(kind(again.joint_of(k)), kind(arm.joint_of(k))) << name << k;
      }
      for (int i = 0; i < 20; ++i) {
        Configuration q(arm.dof());
        for (double& value : q) value = random.uniform(-3, 3);
        EXPECT_TRUE(forward_kinematics(again, q).matrix().isApprox(
            forward_kinematics(arm, q).matrix(), 1e-12))
            << name;
      }
    }
  }
}

TEST(Screws, SmallPitchesReadBack) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const double pitch = std::pow(10, random.uniform(-7, -1));
    const Vector3 point(random.uniform(-10, 10), random.uniform(-1, 1), 0.2);
    Joint joint;
    joint.name = "j";
    joint.screw = rotation_screw({random.uniform(-1, 1), 0.3, 1}, point, pitch);
    const Arm arm("helical", {joint}, random.pose(), random.pose());
    for (const ScrewFrame frame : frames) {
      const Arm again = arm_from_screws("a", screws(arm, frame), home_pose(arm), frame);
      EXPECT_NEAR(beeline::pitch(again.joints()[0]), pitch, 1e-13);
    }
  }
}

TEST(Screws, LinksHaveTheirOriginsOnTheAxes) {
  const Vector3 y = Vector3::UnitY(), z = Vector3::UnitZ();
  const std::vector<Twist> screws = {rotation_screw(z), rotation_screw(y, {0, 5, 1}),
                                     translation_screw(z), rotation_screw(y, {2, 0, 1})};
  const Pose home(Eigen::Translation3d(2, 0, 3));
  const Arm arm = arm_from_screws("a", screws, home, ScrewFrame::space);
  EXPECT_EQ(arm.joints()[0].name, "joint1");
  const Vector3 origins[] = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {2, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(arm.joints()[i].offset.matrix(), Pose(Eigen::Translation3d(origins[i])).matrix());
  }
  EXPECT_EQ(arm.tool().translation(), Vector3(0, 0, 2));
}

TEST(Screws, RoundedNumbersAreMadeExactOrRefused) {
  const auto one = [](const Twist& screw) {
    return arm_from_screws("a", std::vector{screw}, Pose::Identity(), ScrewFrame::space);
  };
  Twist screw;
  screw << 0.7071, 0, -0.7071, 0.7071, 0, 0.7071;
  const Joint joint = one(screw).joints()[0];
  EXPECT_EQ(kind(joint), JointKind::revolute);
  EXPECT_NEAR(joint.screw.tail<3>().norm(), 1, 1e-15);
  EXPECT_EQ(joint.screw.head<3>(), Vector3::Zero());
  screw << 0, 0, 0, 0, 0, 1.1;
  EXPECT_REFUSED(one(screw), "the screw of joint1 has w of length 1.1; a rotation needs 1, and a");
  screw << 0, 0.5, 0, 0, 0, 0;
  EXPECT_REFUSED(one(screw), "joint1 has w = 0 and v of length 0.5; a translation needs 1");
  screw << 0.1, -0.1414, 0.0999, -0.7071, 0, 0.7071;  // v . w is -7e-5
  EXPECT_REFUSED(one(screw),
                 "m/rad, which may be rounding of its digits; a rotation has 0, as with");
  screw << 1, 0, 2e-5, 0, 0, 1;  // w is exact, and half a digit less
  EXPECT_EQ(kind(one(screw).joints()[0]), JointKind::helical);
  screw << 0, 0.3, 1, 0, 0, 1e-17;
  screw.head<3>().normalize();
  EXPECT_EQ(kind(one(screw).joints()[0]), JointKind::prismatic);
  screw << 1, 0, 2e-3, 0, 0, 1;
  EXPECT_EQ(kind(one(screw).joints()[0]), JointKind::helical);
  screw << 1, 0, std::nan(""), 0, 0, 1;
  EXPECT_REFUSED(one(screw), "the screw of joint1 has a number that is not finite");
  EXPECT_REFUSED(arm_from_screws("a", {}, Pose::Identity(), ScrewFrame::body), "has no joints");
  const std::vector<Limits> two(2);
  EXPECT_REFUSED(arm_from_screws("a", std::vector{rotation_screw(Vector3::UnitZ())},
                                 Pose::Identity(), ScrewFrame::body, two),
                 "limits: 2 for 1 joints");
}

}  // namespace
}  // namespace beeline
