#include <gtest/gtest.h>
#include <limits>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double rounding = 1e-12;

Arm any_arm(testing::Random& random) {
  return testing::random_arm(random, random.integer(1, 6), random.integer(0, 3));
}

Configuration joined(const Configuration& first, const Configuration& second) {
  Configuration q(first.size() + second.size());
  q << first, second;
  return q;
}

/// The motion of a mobile base.
Pose base_motion(double x, double y, double heading) {
  return Pose(Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(heading, Vector3::UnitZ()));
}

/// Expects that `moving` at (base, q) is the arm at q, moved by `motion`, with all its links.
void expect_moved(const Arm& moving, const Configuration& base, const Arm& arm,
                  const Configuration& q, const Pose& motion) {
  const Configuration all = joined(base, q);
  ASSERT_EQ(moving.dof(), all.size());
  ASSERT_TRUE(
      forward_kinematics(moving, all).isApprox(motion * forward_kinematics(arm, q), rounding));
  const std::vector<Pose> links = link_poses(moving, all), own = link_poses(arm, q);
  const std::size_t added = links.size() - own.size();
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_TRUE(links[i + added].isApprox(motion * own[i], rounding)) << "link " << i;
  }
}

TEST(MovingBase, ARailTranslatesTheArm) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = any_arm(random);
    const Vector3 axis = random.direction();
    const Arm moving = with_rail(arm, random.uniform(0.01, 100) * axis, {.lower = -2, .upper = 3});
    const double d = random.uniform(-2, 3);
    expect_moved(moving, Configuration::Constant(1, d), arm, random.configuration(arm),
                 Pose(Eigen::Translation3d(d * axis)));
  }
}

TEST(MovingBase, AMobileBaseMovesTheArmInThePlane) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = any_arm(random);
    const Arm moving = with_mobile_base(arm);
    const Vector3 base(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-7, 7));
    expect_moved(moving, base, arm, random.configuration(arm),
                 base_motion(base.x(), base.y(), base.z()));
  }
}

TEST(MovingBase, TheJacobianHasTheColumnsOfTheBaseBeforeThoseOfTheArm) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = any_arm(random);
    const Configuration q = random.configuration(arm);
    const Jacobian own = jacobian(arm, q);
    const Vector3 axis = random.direction();
    const Jacobian rail = jacobian(with_rail(arm, axis),
                                   joined(Configuration::Constant(1, random.uniform(-2, 2)), q));
    EXPECT_TRUE(rail.col(0).head<3>().isApprox(axis, rounding));
    EXPECT_TRUE(rail.col(0).tail<3>().isZero(rounding));
    EXPECT_LT((rail.rightCols(arm.dof()) - own).cwiseAbs().maxCoeff(), 1e-11);

    const Vector3 base(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-7, 7));
    const Arm moving = with_mobile_base(arm);
    const Configuration all = joined(base, q);
    const Jacobian mobile = jacobian(moving, all);
    const Vector3 tool = forward_kinematics(moving, all).translation();
    Eigen::Matrix<double, 6, 3> expected = Eigen::Matrix<double, 6, 3>::Zero();
    expected(0, 0) = expected(1, 1) = expected(5, 2) = 1;
    expected.col(2).head<3>() = Vector3::UnitZ().cross(tool - Vector3(base.x(), base.y(), 0));
    EXPECT_LT((mobile.leftCols<3>() - expected).cwiseAbs().maxCoeff(), 1e-11);
    const Rotation turned = base_motion(0, 0, base.z()).linear();
    Jacobian rotated = own;
    rotated.topRows<3>() = turned * own.topRows<3>();
    rotated.bottomRows<3>() = turned * own.bottomRows<3>();
    EXPECT_LT((mobile.rightCols(arm.dof()) - rotated).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(MovingBase, KeepsTheArmsPartsAndHasItsOwnLimits) {
  const Limits limits{.lower = -1, .upper = 2, .velocity = 0.5, .acceleration = 3, .jerk = 20};
  const Arm arm = with_mount(built_in("ur5"), Pose(Eigen::Translation3d(0, 0, 0.7)));
  const Arm rail = with_rail(arm, Vector3::UnitY(), limits);
  EXPECT_EQ(rail.name(), arm.name());
  EXPECT_EQ(rail.base().matrix(), arm.base().matrix());
  EXPECT_EQ(rail.tool().matrix(), arm.tool().matrix());
  EXPECT_EQ(rail.controller().base.matrix(), arm.controller().base.matrix());
  EXPECT_EQ(rail.joints()[0].name, "rail");
  EXPECT_EQ(rail.joints()[0].link, "carriage");
  EXPECT_EQ(rail.limits(0).lower, -1);
  EXPECT_EQ(rail.limits(0).upper, 2);
  EXPECT_EQ(rail.limits(0).velocity, 0.5);
  EXPECT_EQ(rail.limits(0).acceleration, 3);
  EXPECT_EQ(rail.limits(0).jerk, 20);
  for (int k = 0; k < arm.dof(); ++k) {
    EXPECT_EQ(rail.joint_of(k + 1).name, arm.joint_of(k).name);
    EXPECT_EQ(rail.limits(k + 1).upper, arm.limits(k).upper);
  }
  const Arm mobile = with_mobile_base(arm, {.x = limits, .heading = {.lower = -3, .upper = 3}});
  EXPECT_EQ(mobile.limits(0).upper, 2);
  EXPECT_EQ(mobile.limits(1).upper, Limits::none);
  EXPECT_EQ(mobile.limits(2).upper, 3);
  EXPECT_EQ(kind(mobile.joint_of(2)), JointKind::revolute);
  EXPECT_TRUE(with_rail(built_in("rrr"), Vector3::UnitX()).planar());
  EXPECT_TRUE(with_mobile_base(built_in("rrr")).planar());
  EXPECT_FALSE(with_rail(built_in("rrr"), Vector3::UnitZ()).planar());
}

TEST(MovingBase, NamesAreUnique) {
  Arm arm = built_in("rrr");
  for (int i = 0; i < 3; ++i) arm = with_rail(arm, Vector3::Unit(i));
  arm = with_mobile_base(with_mobile_base(arm));
  const std::vector<std::string> names = arm.joint_names();
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.begin() + 9),
            (std::vector<std::string>{"base_x2", "base_y2", "base_heading2", "base_x", "base_y",
                                      "base_heading", "rail3", "rail2", "rail"}));
  EXPECT_EQ(arm.joints()[6].link, "carriage3");
}

TEST(MovingBase, RefusesAxesWithoutADirectionAndReversedLimits) {
  const Arm arm = built_in("ur5");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = Limits::none;
  for (const Vector3& axis : {Vector3(0, 0, 0), Vector3(1e-10, 0, 0), Vector3(nan, 0, 1),
                              Vector3(inf, 0, 0), Vector3(1e200, 1e200, 0)}) {
    EXPECT_REFUSED(with_rail(arm, axis), "the axis of a rail has the length");
  }
  EXPECT_REFUSED(with_rail(arm, Vector3::UnitX(), {.lower = 2, .upper = 1}), "joint 1 (rail)");
  EXPECT_REFUSED(with_rail(arm, Vector3::UnitX(), {.lower = nan}), "joint 1 (rail)");
  EXPECT_REFUSED(with_rail(arm, Vector3::UnitX(), {.upper = 1e9}), "joint 1 (rail)");
  EXPECT_REFUSED(with_mobile_base(arm, {.heading = {.lower = 2, .upper = 1}}),
                 "joint 3 (base_heading)");
}

}  // namespace
}  // namespace beeline
