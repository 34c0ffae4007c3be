#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>

#include <tests/degrees.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using testing::deg;
constexpr Frame frames[] = {Frame::base, Frame::tool, Frame::space};

/// Column k by central differences of forward kinematics, from the definition of each frame.
Twist difference(const Arm& arm, const Configuration& q, int k, Frame frame) {
  constexpr double h = 1e-5;
  Configuration ahead = q, behind = q;
  ahead[k] += h;
  behind[k] -= h;
  const Pose a = forward_kinematics(arm, ahead), b = forward_kinematics(arm, behind);
  if (frame == Frame::tool) return se3_log(b.inverse() * a) / (2 * h);
  if (frame == Frame::space) return se3_log(a * b.inverse()) / (2 * h);
  return pose_difference(a, b) / (2 * h);
}

void expect_differences(const Arm& arm, const Configuration& q) {
  for (const Frame frame : frames) {
    const Jacobian columns = jacobian(arm, q, frame);
    for (int k = 0; k < arm.dof(); ++k) {
      const Twist numeric = difference(arm, q, k, frame);
      const double size = 1 + numeric.norm();
      ASSERT_LT((columns.col(k) - numeric).norm(), 1e-8 * size * size * size)
          << arm.name() << ", " << name(frame) << ", column " << k;
    }
  }
}

TEST(Jacobian, IsTheDifferenceQuotientForEachJointTypeAndFrame) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    for (const JointKind kind : {JointKind::revolute, JointKind::prismatic, JointKind::helical}) {
      const Arm arm(
          beeline::name(kind),
          {testing::random_joint(random, kind, "a"), testing::random_joint(random, kind, "b")},
          random.pose(), random.pose());
      expect_differences(arm, random.configuration(arm));
    }
  }
}

TEST(Jacobian, IsTheDifferenceQuotientForComposites) {
  testing::Random random;
  for (const char letter : std::string("SUCEH")) {
    std::vector<Joint> joints = composite_joint(letter, "first", 0.2);
    for (Joint& joint : composite_joint(letter, "second", 0.2)) {
      joint.offset = random.pose();
      joints.push_back(joint);
    }
    const Arm arm(std::string(1, letter), joints, random.pose(), random.pose());
    for (int i = 0; i < 50; ++i) expect_differences(arm, random.configuration(arm));
  }
}

TEST(Jacobian, IsTheDifferenceQuotientForMixedChainsWithMimicJoints) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), 2);
    expect_differences(arm, random.configuration(arm));
  }
}

TEST(Jacobian, IsTheDifferenceQuotientForEveryBuiltInArm) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 30; ++i) expect_differences(arm, random.configuration(arm));
  }
}

TEST(Jacobian, IsMappedBetweenFramesByTheAdjoint) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, 6, 4);
    const Configuration q = random.configuration(arm);
    const Pose world_T_tool = forward_kinematics(arm, q);
    const Jacobian base = jacobian(arm, q, Frame::base), tool = jacobian(arm, q, Frame::tool),
                   space = jacobian(arm, q, Frame::space);
    ASSERT_LT((adjoint(world_T_tool) * tool - space).norm(), 1e-12);
    ASSERT_LT((adjoint(make_pose({0, 0, 0}, world_T_tool.linear())) * tool - base).norm(), 1e-12);
    ASSERT_LT((adjoint(make_pose(world_T_tool.translation())) * base - space).norm(), 1e-12);
  }
}

TEST(Jacobian, IsInTheBaseFrameByDefaultAndReturnsTheToolsPose) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, 5, 4);
    const Configuration q = random.configuration(arm);
    ASSERT_EQ(jacobian(arm, q), jacobian(arm, q, Frame::base));
    for (const Frame frame : frames) {
      Jacobian columns = Jacobian::Constant(6, arm.dof(), 7);  // previous content does not matter
      const Pose pose = jacobian(arm, q, columns, frame);
      ASSERT_EQ(columns, jacobian(arm, q, frame));
      ASSERT_LT((pose.matrix() - forward_kinematics(arm, q).matrix()).norm(), 3e-14);
    }
  }
}

TEST(Jacobian, OfTheChaptersArmIsEquation17) {
  testing::Random random;
  const Arm rrr = built_in("rrr");
  for (int i = 0; i < 2000; ++i) {
    const Configuration q = random.configuration(rrr);
    const double s1 = 3.5 * std::sin(q[0]), c1 = 3.5 * std::cos(q[0]);
    const double s2 = 3.5 * std::sin(q[0] + q[1]), c2 = 3.5 * std::cos(q[0] + q[1]);
    const double s3 = 2 * std::sin(q.sum()), c3 = 2 * std::cos(q.sum());
    Eigen::Matrix3d expected;
    expected << -s1 - s2 - s3, -s2 - s3, -s3, c1 + c2 + c3, c2 + c3, c3, 1, 1, 1;
    ASSERT_LT((planar_jacobian(rrr, q) - expected).norm(), 6e-14);
  }
  Eigen::Matrix3d left;
  left << -5.5, -5.5, -2, 3.5, 0, 0, 1, 1, 1;
  const Eigen::Matrix3Xd ours = planar_jacobian(rrr, deg * Eigen::Vector3d(0, 90, 0));
  EXPECT_LT((ours - left).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Jacobian, OfTheGantryIsConstant) {
  testing::Random random;
  const Arm gantry = built_in("gantry");
  Eigen::Matrix<double, 3, 2> expected;
  expected << 1, 0, 0, 1, 0, 0;
  const Eigen::Matrix3Xd at_zero = planar_jacobian(gantry, Eigen::Vector2d::Zero());
  EXPECT_LT((at_zero - expected).norm(), 1e-15);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d q(random.uniform(-100, 100), random.uniform(-100, 100));
    ASSERT_EQ(planar_jacobian(gantry, q), at_zero);
  }
}

/// A planar arm of any letters with any lengths and bends, on any base that is level.
Arm random_planar_arm(testing::Random& random, int joints, bool upside_down) {
  const Pose over = upside_down ? make_pose({0, 0, 0}, rotation({pi, 0, 0})) : Pose::Identity();
  std::vector<Joint> chain;
  for (int j = 0; j < joints; ++j) {
    const char letter = random.integer(0, 3) == 0 ? 'P' : 'R';
    chain.push_back(planar_link(composite_joint(letter, "j" + std::to_string(j)).front(),
                                random.uniform(0, 2), random.uniform(-pi, pi)));
  }
  const Pose level = make_pose(random.vector(), rotation({0, 0, random.uniform(-pi, pi)}));
  return {"planar", chain, over * level, level * over};
}

TEST(PlanarJacobian, HasExactlyOneInTheThirdRowForARevoluteJointAndZeroForAPrismaticOne) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const bool upside_down = i % 2 == 1;
    const Arm arm = random_planar_arm(random, random.integer(1, 6), upside_down);
    ASSERT_TRUE(arm.planar());
    const Configuration q = random.configuration(arm);
    const Eigen::Matrix3Xd planar = planar_jacobian(arm, q);
    const double turn = upside_down ? -1 : 1;  // about -z
    for (int k = 0; k < arm.dof(); ++k) {
      const bool turns = kind(arm.joint_of(k)) == JointKind::revolute;
      ASSERT_EQ(planar(2, k), turns ? turn : 0) << "joint " << k + 1;
    }
    const Jacobian spatial = jacobian(arm, q);
    ASSERT_EQ(planar.topRows<2>(), spatial.topRows<2>());
    ASSERT_LT(spatial.middleRows<3>(2).norm(), 3e-13) << "the out-of-plane rows are zero";
  }
}

TEST(PlanarJacobian, RefusesAnArmThatIsNotPlanar) {
  EXPECT_REFUSED(planar_jacobian(built_in("ur5"), Configuration::Zero(6)), "arm ur5 is not planar");
}

TEST(Jacobian, OfAPlanarChainOfUpToAHundredJointsIsTheSumOfTheLaterLinks) {
  testing::Random random;
  for (const int joints : {1, 10, 30, 100}) {
    std::vector<Joint> chain;
    Configuration q(joints);
    std::vector<double> length(static_cast<std::size_t>(joints));
    for (int j = 0; j < joints; ++j) {
      length[j] = random.uniform(0, 1);
      chain.push_back(
          planar_link(composite_joint('R', "j" + std::to_string(j)).front(), length[j]));
      q[j] = random.uniform(-3, 3);
    }
    const Arm arm("long", chain);
    const Eigen::Matrix3Xd ours = planar_jacobian(arm, q);
    long double x = 0, y = 0, heading = 0;
    for (int j = 0; j < joints; ++j) heading += q[j];
    for (int j = joints - 1; j >= 0; --j) {
      x += length[j] * std::cos(heading);
      y += length[j] * std::sin(heading);
      heading -= q[j];
      ASSERT_NEAR(ours(0, j), static_cast<double>(-y), 3e-14 * (1 + joints));
      ASSERT_NEAR(ours(1, j), static_cast<double>(x), 3e-14 * (1 + joints));
      ASSERT_EQ(ours(2, j), 1);
    }
  }
}

TEST(Jacobian, RefusesBuffersAndConfigurationsOfTheWrongSize) {
  const Arm rrr = built_in("rrr");
  const Configuration q = Configuration::Zero(3);
  for (const int columns : {0, 2, 4}) {
    Jacobian buffer(6, columns);
    EXPECT_REFUSED(jacobian(rrr, q, buffer),
                   "the Jacobian of arm rrr has 3 columns, not " + std::to_string(columns));
  }
  EXPECT_REFUSED(jacobian(rrr, Configuration::Zero(2)), "takes 3 joint values");
  EXPECT_REFUSED(planar_jacobian(rrr, Configuration::Zero(4)), "takes 3 joint values");
  Configuration bad = q;
  bad[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(jacobian(rrr, bad), "joint joint1 is nan");
}

TEST(Frame, HasANameThatReadsBack) {
  for (const Frame frame : frames) EXPECT_EQ(frame_named(name(frame)), frame);
  EXPECT_REFUSED(frame_named("tol"), "unknown frame \"tol\"; did you mean \"tool\"?");
  EXPECT_REFUSED(frame_named(""), "known: base, tool, space");
  EXPECT_REFUSED(frame_named("world"), "tool are the velocity of the tool's origin");
}

}  // namespace
}  // namespace beeline
