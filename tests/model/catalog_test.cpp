#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/degrees.h>
#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using testing::deg;
using Matrix4 = Eigen::Matrix4d;

struct Row {
  double a, alpha, d, theta;
};

Matrix4 along_x(const Row& r) {
  const double c = std::cos(r.alpha), s = std::sin(r.alpha);
  return (Matrix4() << 1, 0, 0, r.a, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1).finished();
}
Matrix4 along_z(const Row& r) {
  const double c = std::cos(r.theta), s = std::sin(r.theta);
  return (Matrix4() << c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, r.d, 0, 0, 0, 1).finished();
}
Matrix4 standard(const std::vector<Row>& rows) {
  Matrix4 product = Matrix4::Identity();
  for (const Row& row : rows) product = product * along_z(row) * along_x(row);
  return product;
}
Matrix4 modified(const std::vector<Row>& rows) {
  Matrix4 product = Matrix4::Identity();
  for (const Row& row : rows) product = product * along_x(row) * along_z(row);
  return product;
}

/// Checks the arm against `expected`, at zero and at 200 random configurations.
template <class Expected>
void expect_chain(const std::string& name, Expected expected) {
  testing::Random random;
  const Arm arm = built_in(name);
  for (int i = 0; i <= 200; ++i) {
    const Configuration q =
        i == 0 ? Configuration(Configuration::Zero(arm.dof())) : random.configuration(arm);
    ASSERT_LT((forward_kinematics(arm, q).matrix() - expected(q)).norm(), 6e-14) << name;
  }
}

Vector3 position_at_zero(const std::string& name) {
  const Arm arm = built_in(name);
  return forward_kinematics(arm, Configuration::Zero(arm.dof())).translation();
}

Matrix4 universal_robot(const Configuration& q, double d1, double a2, double a3, double d4,
                        double d5, double d6) {
  return standard({{0, pi / 2, d1, q[0]},
                   {a2, 0, 0, q[1]},
                   {a3, 0, 0, q[2]},
                   {0, pi / 2, d4, q[3]},
                   {0, -pi / 2, d5, q[4]},
                   {0, 0, d6, q[5]}});
}

TEST(Puma560, IsTheChainOfItsPublishedTable) {
  expect_chain("puma560", [](const Configuration& q) {
    return standard({{0, pi / 2, 0, q[0]},
                     {0.4318, 0, 0, q[1]},
                     {0.0203, -pi / 2, 0.15005, q[2]},
                     {0, pi / 2, 0.4318, q[3]},
                     {0, -pi / 2, 0, q[4]},
                     {0, 0, 0, q[5]}});
  });
  EXPECT_LT((position_at_zero("puma560") - Vector3(0.4521, -0.15005, 0.4318)).norm(), 1e-15);
}

TEST(UniversalRobots, AreTheChainsOfTheMakersTables) {
  expect_chain("ur5", [](const Configuration& q) {
    return universal_robot(q, 0.089159, -0.425, -0.39225, 0.10915, 0.09465, 0.0823);
  });
  expect_chain("ur5e", [](const Configuration& q) {
    return universal_robot(q, 0.1625, -0.425, -0.3922, 0.1333, 0.0997, 0.0996);
  });
  EXPECT_LT((position_at_zero("ur5") - Vector3(-0.81725, -0.19145, -0.005491)).norm(), 1e-15);
  EXPECT_LT((position_at_zero("ur5e") - Vector3(-0.8172, -0.2329, 0.0628)).norm(), 1e-15);
}

TEST(Panda, IsTheChainOfItsTableWithTheFlangeAsTool) {
  expect_chain("panda", [](const Configuration& q) {
    return modified({{0, 0, 0.333, q[0]},
                     {0, -pi / 2, 0, q[1]},
                     {0, pi / 2, 0.316, q[2]},
                     {0.0825, pi / 2, 0, q[3]},
                     {-0.0825, -pi / 2, 0.384, q[4]},
                     {0, pi / 2, 0, q[5]},
                     {0.088, pi / 2, 0, q[6]},
                     {0, 0, 0.107, 0}});
  });
  EXPECT_LT((position_at_zero("panda") - Vector3(0.088, 0, 0.926)).norm(), 1e-15);
}

TEST(Iiwa14, IsTheChainOfItsTable) {
  expect_chain("iiwa14", [](const Configuration& q) {
    return modified({{0, 0, 0.36, q[0]},
                     {0, -pi / 2, 0, q[1]},
                     {0, pi / 2, 0.42, q[2]},
                     {0, pi / 2, 0, q[3]},
                     {0, -pi / 2, 0.4, q[4]},
                     {0, -pi / 2, 0, q[5]},
                     {0, pi / 2, 0.126, q[6]}});
  });
  EXPECT_LT((position_at_zero("iiwa14") - Vector3(0, 0, 1.306)).norm(), 1e-15);
}

TEST(Scara, RotatesThreeTimesAndThenTranslatesTheQuill) {
  expect_chain("scara", [](const Configuration& q) {
    Matrix4 pose = Matrix4::Identity();
    const double heading = q[0] + q[1] - q[2];  // the quill's z points down
    pose.block<2, 3>(0, 0) << std::cos(heading), std::sin(heading), 0, std::sin(heading),
        -std::cos(heading), 0;
    pose(2, 2) = -1;
    pose(0, 3) = 0.325 * std::cos(q[0]) + 0.275 * std::cos(q[0] + q[1]);
    pose(1, 3) = 0.325 * std::sin(q[0]) + 0.275 * std::sin(q[0] + q[1]);
    pose(2, 3) = 0.387 - q[3];
    return pose;
  });
}

TEST(Stanford, IsTheChainOfItsPublishedTable) {
  expect_chain("stanford", [](const Configuration& q) {
    return standard({{0, -pi / 2, 0.412, q[0]},
                     {0, pi / 2, 0.154, q[1]},
                     {0, 0, q[2], -pi / 2},
                     {0, -pi / 2, 0, q[3]},
                     {0, pi / 2, 0, q[4]},
                     {0, 0, 0.263, q[5]}});
  });
}

TEST(BuiltIn, HasTheChaptersJointLettersAndKnownLimits) {
  const auto letters = [](const std::string& name) {
    std::string text;
    const Arm arm = built_in(name);
    for (const Joint& joint : arm.joints()) text += letter(kind(joint));
    return text;
  };
  EXPECT_EQ(letters("rrr"), "RRR");
  EXPECT_EQ(letters("rp"), "RP");
  EXPECT_EQ(letters("gantry"), "PP");
  EXPECT_EQ(letters("puma560"), "RRRRRR");
  EXPECT_EQ(letters("scara"), "RRRP");
  EXPECT_EQ(letters("stanford"), "RRPRRR");
  EXPECT_EQ(letters("panda"), "RRRRRRR");
  const Arm puma = built_in("puma560");
  const double puma_limits[][2] = {{-160, 160}, {-45, 225},  {-225, 45},
                                   {-110, 170}, {-100, 100}, {-266, 266}};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(puma.limits(k).lower, puma_limits[k][0] * deg, 1e-15);
    EXPECT_NEAR(puma.limits(k).upper, puma_limits[k][1] * deg, 1e-15);
  }
  const Arm panda = built_in("panda");
  EXPECT_EQ(panda.limits(3).upper, -0.0698);
  EXPECT_EQ(panda.limits(6).velocity, 2.61);
  EXPECT_EQ(panda.limits(1).acceleration, 7.5);
  EXPECT_EQ(panda.limits(5).jerk, 10000);
  EXPECT_EQ(built_in("rrr").limits(0).upper, Limits::none);
}

TEST(BuiltIn, EveryArmIsListedOnceUnderItsNameWithItsSource) {
  const std::vector<std::string> names = built_in_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  for (const BuiltInArm& about : built_in_arms()) {
    EXPECT_EQ(built_in(about.name).name(), about.name);
    EXPECT_FALSE(about.maker.empty() || about.model.empty()) << about.name;
    EXPECT_GT(about.source.size(), 20u) << about.name;
  }
}

TEST(BuiltIn, SuggestsTheNearestForAnUnknownName) {
  EXPECT_REFUSED(built_in("pandda"), "unknown built-in arm \"pandda\"; did you mean \"panda\"?");
  EXPECT_REFUSED(built_in("Puma560"), "did you mean \"puma560\"?");
  EXPECT_REFUSED(built_in("gentry"), "did you mean \"gantry\"?");
  EXPECT_REFUSED(built_in(""), "known: ");
}

TEST(JointNamings, AJointIsCalledByItsOwnNameAndByTheMakers) {
  const Arm arm = built_in("ur5e");
  EXPECT_EQ(coordinate_called(arm, "joint2"), 1);
  EXPECT_EQ(coordinate_called(arm, "shoulder_lift_joint"), 1);
  EXPECT_EQ(coordinate_called(arm, "joint7"), std::nullopt);
  const Arm other("mine", arm.joints(), arm.tool(), arm.base());
  EXPECT_EQ(coordinate_called(other, "joint2"), 1);
  EXPECT_EQ(coordinate_called(other, "shoulder_lift_joint"), std::nullopt);
}

TEST(PlanarLink, IsTheMatrixOfSection14) {
  testing::Random random;
  const Joint revolute = composite_joint('R', "j").front();
  const Joint prismatic = composite_joint('P', "j").front();
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-2, 4), q = random.uniform(-4, 4);
    const double bend = i % 2 == 0 ? 0 : random.uniform(-3, 3);
    const double c = std::cos(bend + q), s = std::sin(bend + q);
    Matrix4 turn;
    turn << c, -s, 0, a * c, s, c, 0, a * s, 0, 0, 1, 0, 0, 0, 0, 1;
    ASSERT_LT((joint_transform(planar_link(revolute, a, bend), q).matrix() - turn).norm(), 9e-15);
    Matrix4 slide;
    const double cb = std::cos(bend), sb = std::sin(bend);
    slide << cb, -sb, 0, (a + q) * cb, sb, cb, 0, (a + q) * sb, 0, 0, 1, 0, 0, 0, 0, 1;
    ASSERT_LT((joint_transform(planar_link(prismatic, a, bend), q).matrix() - slide).norm(), 9e-15);
  }
}

}  // namespace
}  // namespace beeline
