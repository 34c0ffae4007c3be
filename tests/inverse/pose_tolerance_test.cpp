#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/random_arm.h>
#include <tests/refusal.h>

// Poses with a tolerance for each component, and weights of the joints in distances.

namespace beeline {
namespace {

/// The deviation T_x T_y T_z R_z(yaw) R_y(pitch) R_x(roll) of six numbers, or of x, y, theta.
Pose deviation_pose(const Eigen::VectorXd& deviation) {
  Eigen::Matrix<double, 6, 1> full = Eigen::Matrix<double, 6, 1>::Zero();
  if (deviation.size() == 6) {
    full = deviation;
  } else {
    full.head<2>() = deviation.head<2>();
    full[5] = deviation[2];
  }
  Pose pose = make_pose(full.head<3>());
  pose.linear() =
      (Eigen::AngleAxisd(full[5], Vector3::UnitZ()) * Eigen::AngleAxisd(full[4], Vector3::UnitY()) *
       Eigen::AngleAxisd(full[3], Vector3::UnitX()))
          .toRotationMatrix();
  return pose;
}

/// Checks the solution and its deviation by forward kinematics.
void expect_within(const Arm& arm, const Pose& goal, const Eigen::VectorXd& tolerance,
                   const InverseResult& result) {
  ASSERT_EQ(result.status, InverseStatus::solved) << arm.name() << ": " << result.reason;
  ASSERT_EQ(result.solutions.size(), 1U);
  ASSERT_TRUE(result.deviation) << result.method;
  const Configuration& q = result.solutions.front();
  EXPECT_TRUE(within(internal::bounds_of(arm), q)) << arm.name() << ' ' << q.transpose();
  EXPECT_TRUE((result.deviation->cwiseAbs().array() <= tolerance.array()).all())
      << result.deviation->transpose();
  const Pose tool = goal * deviation_pose(*result.deviation);
  EXPECT_LT((forward_kinematics(arm, q).matrix() - tool.matrix()).cwiseAbs().maxCoeff(), 1e-9);
}

Arm without_last_joint(const Arm& arm) {
  return {"shorter", {arm.joints().begin(), arm.joints().end() - 1}, arm.tool(), arm.base()};
}

TEST(PoseTolerance, IsUsedAsFarAsNeeded) {
  testing::Random random;
  int no_larger = 0;  // than a deviation that is known to do; the least is found locally
  for (int i = 0; i < 40; ++i) {
    // Arms of five joints reach hardly any pose exactly.
    const Arm arm = without_last_joint(built_in(i % 2 == 0 ? "ur5" : "puma560"));
    Eigen::VectorXd tolerance(6), applied(6);
    tolerance << 0.01, 0, 0.02, 0.2, 0.1, 0.3;
    for (int k = 0; k < 6; ++k) applied[k] = random.uniform(-0.9, 0.9) * tolerance[k];
    const Configuration q = random.configuration(arm);
    const Pose goal = forward_kinematics(arm, q) * deviation_pose(applied).inverse();
    const InverseResult result =
        inverse_kinematics(arm, goal, {.seed = q, .pose_tolerance = tolerance});
    expect_within(arm, goal, tolerance, result);
    if (!result.deviation) continue;
    const auto squares = [&](const Eigen::VectorXd& deviation) {
      double sum = 0;
      for (int k = 0; k < 6; ++k) {
        if (tolerance[k] > 0) sum += std::pow(deviation[k] / tolerance[k], 2);
      }
      return sum;
    };
    if (squares(*result.deviation) <= squares(applied) + 1e-3) ++no_larger;
  }
  EXPECT_GE(no_larger, 36);
}

TEST(PoseTolerance, OfAPlanarArmIsXYTheta) {
  const Arm arm = built_in("rrr");
  const Pose goal = make_pose({6.4, 6.4, 0});  // 0.05 m out of reach
  const Eigen::Vector3d tolerance(0.1, 0.1, 1);
  expect_within(arm, goal, tolerance, inverse_kinematics(arm, goal, {.pose_tolerance = tolerance}));
}

TEST(PoseTolerance, IsNotUsedWhereThePoseHasASolution) {
  testing::Random random;
  for (const char* name : {"ur5", "panda", "rrr"}) {
    const Arm arm = built_in(name);
    const Eigen::VectorXd tolerance = Eigen::VectorXd::Constant(arm.planar() ? 3 : 6, 0.1);
    for (int i = 0; i < 20; ++i) {
      const Pose goal = forward_kinematics(arm, random.configuration(arm));
      const InverseResult result = inverse_kinematics(arm, goal, {.pose_tolerance = tolerance});
      EXPECT_FALSE(result.deviation) << name << ' ' << result.reason;
      const InverseResult exact = inverse_kinematics(arm, goal);
      ASSERT_TRUE(result && exact);
      EXPECT_EQ(result.solutions.front(), exact.solutions.front());
    }
  }
}

TEST(PoseTolerance, TooSmallIsNoSolution) {
  const InverseResult result = testing::explained_inverse(
      built_in("rrr"), make_pose({8, 8, 0}), {.pose_tolerance = Eigen::Vector3d(0.1, 0.1, 1)});
  testing::expect_no(result, InverseStatus::unreachable);
  EXPECT_TRUE(result.reason.has(ReasonField::within_pose_tolerance)) << result.reason;
  EXPECT_FALSE(result.deviation);
}

TEST(PoseTolerance, KeepsALockedJointAndIgnoredLimits) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Eigen::VectorXd tolerance = Eigen::VectorXd::Constant(6, 0.05);
  for (int i = 0; i < 10; ++i) {
    const Configuration q = random.configuration(arm);
    Eigen::VectorXd applied(6);
    for (double& value : applied) value = random.uniform(-0.03, 0.03);
    const Pose goal = forward_kinematics(arm, q) * deviation_pose(applied).inverse();
    const InverseResult result = inverse_kinematics(
        arm, goal, {.seed = q, .ignore_limits = true, .lock = 2, .pose_tolerance = tolerance});
    ASSERT_TRUE(result) << result.reason;
    EXPECT_EQ(result.solutions.front()[2], q[2]);
    ASSERT_TRUE(result.deviation);
    const Pose tool = goal * deviation_pose(*result.deviation);
    EXPECT_TRUE(forward_kinematics(arm, result.solutions.front()).isApprox(tool, 1e-9));
  }
}

TEST(PoseTolerance, IsRefusedWithWhatItNeeds) {
  const Arm arm = built_in("ur5");
  const auto ask = [&](const Eigen::VectorXd& tolerance) {
    return inverse_kinematics(arm, arm.base(), {.pose_tolerance = tolerance});
  };
  EXPECT_REFUSED(ask(Eigen::VectorXd::Constant(3, 0.1)), "needs 6: x, y, z (m), roll, pitch, yaw");
  EXPECT_REFUSED(ask(Eigen::VectorXd::Constant(6, -0.1)), "-0.1");
  EXPECT_REFUSED(ask(Eigen::VectorXd::Constant(6, 4)), "0 to pi");
  EXPECT_REFUSED(ask(Eigen::VectorXd::Constant(6, std::nan(""))), "nan");
}

/// The weighted distance of two configurations.
double distance(const Eigen::VectorXd& weights, const Configuration& a, const Configuration& b) {
  return std::sqrt(weights.dot((a - b).cwiseAbs2()));
}

TEST(Weights, TheNearestIsNearestByThem) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 10; ++i) {
      Eigen::VectorXd weights(7);
      for (double& weight : weights) weight = std::exp(random.uniform(-3, 3));
      const Configuration seed = random.configuration(arm);
      const Pose goal = forward_kinematics(arm, random.configuration(arm));
      const InverseResult nearest = inverse_kinematics(
          arm, goal,
          {.seed = seed, .redundancy = Redundancy::nearest, .weights = weights, .grid = 64});
      testing::expect_solved(arm, goal, Task::spatial(), nearest);
      const double least = distance(weights, nearest.solutions.front(), seed);
      const InverseResult all = inverse_kinematics(
          arm, goal, {.seed = seed, .all = true, .weights = weights, .grid = 64});
      double before = 0;
      for (const Configuration& q : all.solutions) {
        const double here = distance(weights, q, seed);
        EXPECT_GE(here, before);  // sorted by them
        before = here;
        EXPECT_GE(here, least - 1e-6) << name;
      }
    }
  }
}

TEST(Weights, OrderTheSolutionsOfSixJoints) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 50; ++i) {
    Eigen::VectorXd weights(6);
    for (double& weight : weights) weight = std::exp(random.uniform(-3, 3));
    const Configuration seed = random.configuration(arm);
    const Pose goal = forward_kinematics(arm, random.configuration(arm));
    const InverseResult all =
        inverse_kinematics(arm, goal, {.seed = seed, .all = true, .weights = weights});
    const InverseResult one = inverse_kinematics(arm, goal, {.seed = seed, .weights = weights});
    ASSERT_TRUE(one && all);
    EXPECT_NEAR(distance(weights, one.solutions.front(), seed),
                distance(weights, all.solutions.front(), seed), 1e-9);
  }
}

TEST(Weights, AreRefusedWithTheirRange) {
  const Arm arm = built_in("ur5");
  const auto ask = [&](const Eigen::VectorXd& weights) {
    return inverse_kinematics(arm, arm.base(), {.weights = weights});
  };
  EXPECT_REFUSED(ask(Eigen::VectorXd::Ones(5)), "has 6 coordinates");
  EXPECT_REFUSED(ask(Eigen::VectorXd::Zero(6)), "from 1e-6 to 1e6");
}

}  // namespace
}  // namespace beeline
