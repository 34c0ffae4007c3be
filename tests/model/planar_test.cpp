#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

using std::numbers::pi;

Arm chain(const std::string& letters, const Pose& tool = Pose::Identity(),
          const Pose& base = Pose::Identity(), double pitch = 0.1) {
  std::vector<Joint> joints;
  for (const char letter : letters) {
    const std::string name = "joint" + std::to_string(joints.size() + 1);
    for (Joint& joint : composite_joint(letter, name, pitch)) {
      joints.push_back(planar_link(joint, 0.5));
    }
  }
  return {letters, joints, tool, base};
}

TEST(Planar, AreChainsOfRotationsAboutZAndTranslationsInThePlane) {
  for (const char* letters : {"R", "P", "RRR", "RP", "PP", "RPRPR", "E", "REP", "RRRRRRRR"}) {
    EXPECT_TRUE(chain(letters).planar()) << letters;
  }
  for (const char* letters : {"S", "U", "C", "H", "RRH", "RSR", "PC"}) {
    EXPECT_FALSE(chain(letters).planar()) << letters;
  }
}

TEST(Planar, HelicalIsPlanarOnlyWithoutPitch) {
  EXPECT_TRUE(chain("RH", Pose::Identity(), Pose::Identity(), 0).planar());
  EXPECT_FALSE(chain("RH", Pose::Identity(), Pose::Identity(), 1e-6).planar());
}

TEST(Planar, BuiltInArmsAreThoseOfTheChapter) {
  for (const BuiltInArm& about : built_in_arms()) {
    EXPECT_EQ(built_in(about.name).planar(), about.maker == "Dellaert") << about.name;
  }
}

TEST(Planar, HoldsForABaseRotatedAboutZButNotForATiltedOne) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Pose level = make_pose(random.vector(3), rotation({0, 0, random.uniform(-pi, pi)}));
    EXPECT_TRUE(chain("RPR", Pose::Identity(), level).planar());
    EXPECT_TRUE(chain("RPR", level).planar());
    const double tilt = (random.integer(0, 1) == 0 ? 1 : -1) * std::pow(10, random.uniform(-7, 0));
    const Vector3 axis(std::cos(i), std::sin(i), 0);
    const Pose tilted = make_pose(random.vector(3), so3_exp(tilt * axis));
    EXPECT_FALSE(chain("RPR", Pose::Identity(), tilted).planar()) << "base tilted by " << tilt;
    EXPECT_FALSE(chain("RPR", tilted).planar()) << "tool tilted by " << tilt;
  }
}

TEST(Planar, HoldsForAxesAlongMinusZWithTheToolsZUp) {
  const Pose over = make_pose({0, 0, 0}, rotation({pi, 0, 0}));
  EXPECT_TRUE(chain("RR", over, over).planar());
  EXPECT_FALSE(chain("RR", Pose::Identity(), over).planar()) << "the tool's z points down";
}

TEST(Planar, MeansThatTheToolStaysInItsPlaneWithZUp) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Pose level = make_pose(random.vector(3), rotation({0, 0, random.uniform(-pi, pi)}));
    const Arm arm = chain(i % 2 == 0 ? "RPRE" : "PRRR",
                          random.integer(0, 1) == 0 ? level : Pose::Identity(), level);
    ASSERT_TRUE(arm.planar());
    const double height = forward_kinematics(arm, Configuration::Zero(arm.dof())).translation().z();
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    ASSERT_LT((pose.matrix() - to_space(to_plane(pose), height).matrix()).norm(), 3e-13);
  }
}

}  // namespace
}  // namespace beeline
