#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/degrees.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::deg;

void expect_planar(const Arm& arm, const Configuration& q, const Pose2& expected,
                   double tolerance) {
  const Pose2 pose = to_plane(forward_kinematics(arm, q));
  ASSERT_NEAR(pose.x, expected.x, tolerance);
  ASSERT_NEAR(pose.y, expected.y, tolerance);
  ASSERT_NEAR(std::remainder(pose.theta - expected.theta, 360 * deg), 0, tolerance);
}

TEST(ForwardKinematics, GivesTheChaptersNumbers) {
  const Arm rrr = built_in("rrr");
  expect_planar(rrr, deg * Eigen::Vector3d(112, -52, -60), {2.43888, 6.27623, 0}, 1e-5);
  expect_planar(rrr, deg * Eigen::Vector3d(60, -45, -90), {5.64838, 2.00510, -75 * deg}, 1e-5);
  expect_planar(rrr, deg * Eigen::Vector3d(99.2, -68.8, -30.4), {4.459, 5.226, 0}, 5e-4);
  expect_planar(rrr, Eigen::Vector3d::Zero(), {9, 0, 0}, 0);
}

TEST(ForwardKinematics, IsTheChaptersFormulaForThePlanarArm) {
  testing::Random random;
  const Arm rrr = built_in("rrr");
  for (int i = 0; i < 2000; ++i) {
    const Configuration q = random.configuration(rrr);
    const double a = q[0] + q[1], b = a + q[2];
    expect_planar(rrr, q,
                  {3.5 * std::cos(q[0]) + 3.5 * std::cos(a) + 2 * std::cos(b),
                   3.5 * std::sin(q[0]) + 3.5 * std::sin(a) + 2 * std::sin(b), b},
                  3e-14);
  }
}

TEST(ForwardKinematics, AnswersTheChaptersExercisesForAnyConfiguration) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const double turn = random.uniform(-9, 9), d = random.uniform(-5, 5), e = random.uniform(-5, 5);
    expect_planar(built_in("rp"), Eigen::Vector2d(turn, d),
                  {(1 + d) * std::cos(turn), (1 + d) * std::sin(turn), turn}, 9e-14);
    expect_planar(built_in("gantry"), Eigen::Vector2d(d, e), {d, e, 90 * deg}, 3e-14);
  }
}

TEST(ForwardKinematics, ActuatesCompositesInTheOrderOfTheirJoints) {
  std::vector<Joint> joints;
  for (const char letter : std::string("ES")) {
    for (Joint& joint : composite_joint(letter, std::string(1, letter))) joints.push_back(joint);
  }
  const Arm arm("es", joints);
  ASSERT_EQ(arm.dof(), 6);
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Configuration q = random.configuration(arm);
    const Pose expected = Eigen::Translation3d(q[0], q[1], 0) *
                          Eigen::AngleAxisd(q[2] + q[3], Vector3::UnitZ()) *
                          Eigen::AngleAxisd(q[4], Vector3::UnitY()) *
                          Eigen::AngleAxisd(q[5], Vector3::UnitX()) * Pose::Identity();
    ASSERT_LT((forward_kinematics(arm, q).matrix() - expected.matrix()).norm(), 2e-14);
  }
}

TEST(LinkPoses, AreThePartialProductsOfEquation11) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 10), 3);
    const Configuration q = random.configuration(arm);
    const std::vector<Pose> world_T_link = link_poses(arm, q);
    ASSERT_EQ(world_T_link.size(), arm.joints().size() + 1);
    ASSERT_EQ(world_T_link[0].matrix(), arm.base().matrix());
    for (std::size_t j = 0; j < arm.joints().size(); ++j) {
      const Arm::JointCoupling& coupling = arm.couplings()[j];
      const double value = coupling.ratio * q[coupling.coordinate] + coupling.shift;
      const Joint& joint = arm.joints()[j];
      const Pose step = joint.offset * se3_exp(joint.screw * value);
      ASSERT_LT((world_T_link[j + 1].matrix() - (world_T_link[j] * step).matrix()).norm(), 3e-13);
    }
    const Pose tool = world_T_link.back() * arm.tool();
    ASSERT_LT((forward_kinematics(arm, q).matrix() - tool.matrix()).norm(), 3e-13);
  }
}

TEST(LinkPoses, OfThePlanarArmEndAtItsJoints) {
  const std::vector<Pose> links = link_poses(built_in("rrr"), deg * Eigen::Vector3d(0, 90, 0));
  ASSERT_EQ(links.size(), 4);
  EXPECT_LT((links[0].translation() - Vector3(0, 0, 0)).norm(), 1e-15);
  EXPECT_LT((links[1].translation() - Vector3(3.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((links[2].translation() - Vector3(3.5, 3.5, 0)).norm(), 1e-15);
  EXPECT_LT((links[3].translation() - Vector3(3.5, 5.5, 0)).norm(), 3e-15);
}

TEST(ForwardKinematics, MovesWithTheBaseAndTheTool) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, 5);
    const Pose shift = random.pose(2), grip = random.pose();
    const Arm moved("moved", arm.joints(), arm.tool() * grip, shift * arm.base());
    const Configuration q = random.configuration(arm);
    const Pose expected = shift * forward_kinematics(arm, q) * grip;
    ASSERT_LT((forward_kinematics(moved, q).matrix() - expected.matrix()).norm(), 2e-13);
  }
}

TEST(ForwardKinematics, DoesNotDependOnTheLinkFrames) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, 5);
    std::vector<Joint> joints = arm.joints();
    const std::size_t j = static_cast<std::size_t>(random.integer(0, 3));
    const Pose link_T_frame = random.pose();
    joints[j] = with_link_frame(joints[j], link_T_frame);
    joints[j + 1].offset = link_T_frame.inverse() * joints[j + 1].offset;
    const Arm same("same", joints, arm.tool(), arm.base());
    const Configuration q = random.configuration(arm);
    ASSERT_LT((forward_kinematics(same, q).matrix() - forward_kinematics(arm, q).matrix()).norm(),
              3e-13);
  }
}

TEST(ForwardKinematics, SumsAPlanarChainOfUpToAHundredJoints) {
  testing::Random random;
  for (const int joints : {1, 2, 3, 10, 30, 100}) {
    std::vector<Joint> chain;
    Configuration q(joints);
    long double x = 0, y = 0, heading = 0;
    for (int j = 0; j < joints; ++j) {
      const double length = random.uniform(0, 1), bend = random.uniform(-3, 3);
      const bool slides = j % 5 == 3;
      const std::string name = "j" + std::to_string(j);
      chain.push_back(planar_link(composite_joint(slides ? 'P' : 'R', name).front(), length, bend));
      q[j] = random.uniform(-2, 2);
      heading += static_cast<long double>(bend) + (slides ? 0 : q[j]);
      const long double step = static_cast<long double>(length) + (slides ? q[j] : 0);
      x += step * std::cos(heading);
      y += step * std::sin(heading);
    }
    const Arm arm("long", chain);
    const Pose2 expected{static_cast<double>(x), static_cast<double>(y),
                         static_cast<double>(heading)};
    expect_planar(arm, q, expected, 3e-14 * (1 + joints));
    ASSERT_LT(
        (forward_kinematics(arm, q).linear() * forward_kinematics(arm, q).linear().transpose() -
         Rotation::Identity())
            .norm(),
        3e-15 * (2 + joints));
  }
}

TEST(ForwardKinematics, TakesAnyFiniteConfigurationAndNoOther) {
  const Arm panda = built_in("panda");
  EXPECT_TRUE(forward_kinematics(panda, Configuration::Constant(7, 1e6)).matrix().allFinite());
  EXPECT_REFUSED(forward_kinematics(panda, Configuration::Zero(6)), "takes 7 joint values");
  EXPECT_REFUSED(link_poses(panda, Configuration::Zero(8)), "takes 7 joint values");
  Configuration q = Configuration::Zero(7);
  q[6] = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(forward_kinematics(panda, q), "joint joint7 is inf");
  EXPECT_REFUSED(link_poses(panda, q), "joint joint7 is inf");
}

TEST(PoseInPlane, HasTheHeightOfThePlanarArm) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const Vector3 stand = random.vector();
    const Pose mount = make_pose(stand, rotation({0, 0, random.uniform(-3, 3)}));
    const Arm arm = with_mount(built_in("rrr"), mount);
    const Pose tool = forward_kinematics(arm, random.configuration(arm));
    EXPECT_LT((pose_in_plane(arm, to_plane(tool)).matrix() - tool.matrix()).norm(), 1e-13);
  }
  EXPECT_REFUSED(pose_in_plane(built_in("ur5"), {1, 2, 3}), "x,y,theta is for planar arms; ");
}

TEST(LinkPoses, RefusesABufferOfTheWrongSize) {
  const Arm rrr = built_in("rrr");
  const Configuration q = Configuration::Zero(3);
  for (const std::size_t size : {0, 3, 5}) {
    std::vector<Pose> buffer(size);
    EXPECT_REFUSED(link_poses(rrr, q, buffer), "a buffer of 4 poses, not " + std::to_string(size));
  }
}

TEST(ConfigurationRef, TakesListsVectorsAndSpans) {
  const Arm arm = built_in("rrr");
  const Configuration q = Eigen::Vector3d(0.3, -0.8, 1.2);
  const std::vector<double> numbers{0.3, -0.8, 1.2};
  const Eigen::Matrix4d expected = forward_kinematics(arm, q).matrix();
  EXPECT_EQ(forward_kinematics(arm, {0.3, -0.8, 1.2}).matrix(), expected);
  EXPECT_EQ(forward_kinematics(arm, numbers).matrix(), expected);
  EXPECT_EQ(forward_kinematics(arm, std::span(numbers)).matrix(), expected);
  EXPECT_EQ(forward_kinematics(arm, q / 2 + q / 2).matrix(), expected);
  EXPECT_EQ(link_poses(arm, {0.3, -0.8, 1.2}).size(), 4);
  EXPECT_REFUSED(forward_kinematics(arm, {0.3, -0.8}), "takes 3 joint values");
  EXPECT_REFUSED(forward_kinematics(arm, std::vector<double>()), "not 0");
}

}  // namespace
}  // namespace beeline
