#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
constexpr double inf = std::numeric_limits<double>::infinity();

/// The x and y rows of a planar 2R arm's Jacobian.
Eigen::MatrixXd two_link(double l1, double l2, double q1, double q2) {
  const Arm arm("2r", {planar_link(composite_joint('R', "a").front(), l1),
                       planar_link(composite_joint('R', "b").front(), l2)});
  return planar_jacobian(arm, Eigen::Vector2d(q1, q2)).topRows<2>();
}

TEST(Manipulability, OfATwoLinkArmIsItsClosedForm) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const double l1 = random.uniform(0.1, 2), l2 = random.uniform(0.1, 2);
    const double q1 = random.uniform(-pi, pi), q2 = random.uniform(-pi, pi);
    const ManipulabilityMeasures measures = manipulability_measures(two_link(l1, l2, q1, q2));
    const double area = l1 * l2 * std::abs(std::sin(q2));
    ASSERT_NEAR(measures.manipulability, area, 3e-14);
    // s1 s2 = area and s1^2 + s2^2 = |J|^2 = |tip|^2 + l2^2 give both singular values.
    const double squares = l1 * l1 + 2 * l2 * l2 + 2 * l1 * l2 * std::cos(q2);
    const double largest =
        std::sqrt((squares + std::sqrt(std::max(0.0, squares * squares - 4 * area * area))) / 2);
    ASSERT_EQ(measures.singular_values.size(), 2);
    ASSERT_NEAR(measures.singular_values[0], largest, 1e-7 * largest);
    if (area < 1e-3) continue;
    ASSERT_NEAR(measures.condition, largest * largest / area, 1e-6 * measures.condition);
  }
}

TEST(Manipulability, HasInfiniteConditionAtASingularity) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const double q1 = random.uniform(-pi, pi);
    const double q2 = i % 2 == 0 ? 0 : pi;
    const ManipulabilityMeasures measures =
        manipulability_measures(two_link(random.uniform(0.5, 2), random.uniform(0.5, 2), q1, q2));
    ASSERT_EQ(measures.condition, inf) << q1 << " " << q2;
    ASSERT_LT(measures.manipulability, 3e-15);
  }
}

TEST(Manipulability, IsSingularForAnAlignedWristOnly) {
  testing::Random random;
  const Arm puma = built_in("puma560");
  for (int i = 0; i < 500; ++i) {
    Configuration q = random.configuration(puma);
    q[4] = random.uniform(0.3, 1.2);
    q[2] = random.uniform(-1, 0.5);
    ASSERT_LT(manipulability_measures(jacobian(puma, q)).condition, 1e9);
    q[4] = 0;
    ASSERT_EQ(manipulability_measures(jacobian(puma, q)).condition, inf) << q.transpose();
  }
}

TEST(Manipulability, IsYoshikawasMeasure) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const int rows = random.integer(1, 6);
    Eigen::MatrixXd matrix(rows, rows + random.integer(0, 4));
    for (double& entry : matrix.reshaped()) entry = random.uniform(-1, 1);
    const double determinant = (matrix * matrix.transpose()).determinant();
    ASSERT_NEAR(std::pow(manipulability_measures(matrix).manipulability, 2), determinant,
                3e-13 * std::pow(matrix.norm(), 2 * rows));
  }
}

TEST(Manipulability, HasTheRootsOfTheEigenvaluesInDecreasingOrder) {
  testing::Random random;
  for (int i = 0; i < 500; ++i) {
    const Arm arm = testing::random_arm(random, 8);
    const Jacobian columns = jacobian(arm, random.configuration(arm));
    const ManipulabilityMeasures measures = manipulability_measures(columns);
    const Eigen::VectorXd squares =
        Eigen::SelfAdjointEigenSolver<Matrix6>(columns * columns.transpose()).eigenvalues();
    for (int k = 0; k < 6; ++k) {
      ASSERT_NEAR(std::pow(measures.singular_values[k], 2), squares[5 - k], 1e-12 * squares[5]);
    }
  }
}

TEST(Manipulability, DoesNotDependOnTheAxesItIsWrittenIn) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, 7);
    const Configuration q = random.configuration(arm);
    const ManipulabilityMeasures base = manipulability_measures(jacobian(arm, q, Frame::base));
    const ManipulabilityMeasures tool = manipulability_measures(jacobian(arm, q, Frame::tool));
    const double size = base.singular_values[0];
    ASSERT_LT((base.singular_values - tool.singular_values).norm(), 3e-13 * size);
  }
}

TEST(Manipulability, WithFewerJointsThanRowsIsZeroYetHasACondition) {
  const ManipulabilityMeasures two =
      manipulability_measures(jacobian(built_in("rp"), Eigen::Vector2d(0.3, 1)));
  EXPECT_EQ(two.singular_values.size(), 2);
  EXPECT_EQ(two.manipulability, 0);
  EXPECT_TRUE(std::isfinite(two.condition));
  const ManipulabilityMeasures gantry = manipulability_measures(two_link(1, 1, 0, pi / 2));
  EXPECT_NEAR(gantry.manipulability, 1, 1e-15);
}

TEST(Manipulability, OfOrthonormalRowsIsOneAndOfZeroIsInfinite) {
  testing::Random random;
  const ManipulabilityMeasures turn = manipulability_measures(random.rotation());
  EXPECT_NEAR(turn.condition, 1, 1e-14);
  EXPECT_NEAR(turn.manipulability, 1, 1e-14);
  EXPECT_EQ(manipulability_measures(Eigen::MatrixXd::Zero(3, 4)).condition, inf);
  EXPECT_EQ(manipulability_measures(Eigen::MatrixXd::Zero(3, 4)).manipulability, 0);
}

TEST(Manipulability, ScalesWithTheJacobian) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 100; ++i) {
    const Jacobian columns = jacobian(arm, random.configuration(arm));
    const ManipulabilityMeasures measures = manipulability_measures(columns);
    for (const double scale : {1e-150, 1e-100, 1e100, 1e300}) {
      const ManipulabilityMeasures scaled = manipulability_measures(scale * columns);
      const double largest = measures.singular_values[0];
      ASSERT_LT((scaled.singular_values / scale - measures.singular_values).norm(),
                1e-14 * largest);
      ASSERT_NEAR(scaled.condition, measures.condition,
                  1e-14 * measures.condition * measures.condition);
    }
  }
}

TEST(Manipulability, RefusesAnEmptyMatrixAndNumbersThatAreNotFinite) {
  EXPECT_REFUSED(manipulability_measures(Eigen::MatrixXd(6, 0)), "at least one row and one column");
  EXPECT_REFUSED(manipulability_measures(Eigen::MatrixXd(0, 6)), "at least one row and one column");
  EXPECT_REFUSED(manipulability_measures(Eigen::MatrixXd::Ones(7, 3)), "at most 6 rows, not 7");
  Eigen::MatrixXd bad = Eigen::MatrixXd::Ones(2, 2);
  bad(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(manipulability_measures(bad), "finite");
  bad(1, 1) = inf;
  EXPECT_REFUSED(manipulability_measures(bad), "finite");
}

TEST(Manipulability, GradientIsTheDifferenceQuotient) {
  testing::Random random;
  int compared = 0;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (const char* rows : {"spatial", "position", "000111", "planar", "110001:tool", "001000"}) {
      const Task task = task_named(rows);
      for (int i = 0; i < 20; ++i) {
        const Configuration q = random.configuration(arm);
        const ManipulabilityGradient found = manipulability_gradient(arm, q, task);
        const auto measure = [&](const Configuration& at) {
          return manipulability_measures(task_jacobian(arm, at, task)).manipulability;
        };
        ASSERT_NEAR(found.manipulability, measure(q), 1e-13 * (1 + found.manipulability));
        if (found.manipulability < 1e-3) continue;  // kinks near singularities
        ++compared;
        for (int k = 0; k < arm.dof(); ++k) {
          const Configuration step = 1e-6 * Configuration::Unit(arm.dof(), k);
          const double numeric = (measure(q + step) - measure(q - step)) / 2e-6;
          ASSERT_NEAR(found.gradient[k], numeric, 1e-6 * (1 + std::abs(numeric)))
              << name << ' ' << rows << ' ' << k;
        }
      }
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(Manipulability, EllipsoidsHaveTheVelocitiesOfUnitJointVelocities) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const int rows = random.integer(1, 6), columns = random.integer(1, 8);
    const Eigen::MatrixXd j = Eigen::MatrixXd::Random(rows, columns);
    const ManipulabilityEllipsoids found = manipulability_ellipsoids(j);
    const Eigen::MatrixXd square =
        found.axes * found.velocity.cwiseAbs2().asDiagonal() * found.axes.transpose();
    ASSERT_LT((square - j * j.transpose()).norm(), 1e-13 * (1 + square.norm()));
    ASSERT_LT((found.axes.transpose() * found.axes - Eigen::MatrixXd::Identity(rows, rows)).norm(),
              1e-13);
    for (int k = 0; k < rows; ++k) {
      if (k >= columns) {
        ASSERT_EQ(found.force[k], inf);
        continue;
      }
      const Eigen::VectorXd torques = j.transpose() * found.force[k] * found.axes.col(k);
      ASSERT_NEAR(torques.norm(), 1, 1e-9);
    }
  }
}

TEST(JointTorques, OfAWeightAtTheTipAreItsLevers) {
  testing::Random random;
  const double l1 = 0.7, l2 = 0.4;
  const Arm arm("2r", {planar_link(composite_joint('R', "a").front(), l1),
                       planar_link(composite_joint('R', "b").front(), l2)});
  for (int i = 0; i < 100; ++i) {
    const double q1 = random.uniform(-pi, pi), q2 = random.uniform(-pi, pi);
    const double outer = l2 * std::cos(q1 + q2), x = l1 * std::cos(q1) + outer;
    const Twist up = 10 * Twist::Unit(1);  // the tool holds 10 N, along y
    const Configuration torques = joint_torques(arm, Eigen::Vector2d(q1, q2), up);
    EXPECT_NEAR(torques[0], 10 * x, 1e-13);
    EXPECT_NEAR(torques[1], 10 * outer, 1e-13);
  }
}

TEST(JointTorques, AreThoseOfOneWrenchInAllFrames) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const Configuration q = random.configuration(arm);
    Twist base, tool, space;
    const Pose world_T_tool = forward_kinematics(arm, q);
    const Vector3 force = random.vector(), moment = random.vector();  // about the tool's origin
    const auto axes = world_T_tool.linear().transpose();
    base << force, moment;
    tool << axes * force, axes * moment;
    space << force, moment + world_T_tool.translation().cross(force);
    const Configuration expected = joint_torques(arm, q, base);
    EXPECT_LT((joint_torques(arm, q, tool, Frame::tool) - expected).norm(), 1e-12);
    EXPECT_LT((joint_torques(arm, q, space, Frame::space) - expected).norm(), 1e-12);
    EXPECT_REFUSED(joint_torques(arm, q, Twist::Constant(inf)), "wrench");
  }
}

TEST(Manipulability, OfAPlanarArmIsOfItsPlanarRowsByDefault) {
  const Arm rrr = built_in("rrr");
  const Configuration q = Vector3(0, 1.57, 0);
  const double area = manipulability_measures(planar_jacobian(rrr, q)).manipulability;
  EXPECT_NEAR(area, 3.5 * 3.5 * std::sin(1.57), 1e-12);
  EXPECT_NEAR(manipulability_gradient(rrr, q).manipulability, area, 1e-12);
  EXPECT_EQ(task_jacobian(rrr, q), planar_jacobian(rrr, q));
  const Arm panda = built_in("panda");
  const Configuration bent = Configuration::Constant(7, -0.5);
  EXPECT_EQ(task_jacobian(panda, bent), jacobian(panda, bent));
  EXPECT_EQ(manipulability_gradient(panda, bent).manipulability,
            manipulability_gradient(panda, bent, Task::spatial()).manipulability);
}

TEST(Manipulability, GradientIsZeroWhereTheMeasureIs) {
  const Arm arm = built_in("panda");
  const ManipulabilityGradient found =
      manipulability_gradient(arm, Configuration(Configuration::Zero(7)));
  EXPECT_EQ(found.manipulability, 0);
  EXPECT_EQ(found.gradient, Configuration::Zero(7));
}

}  // namespace
}  // namespace beeline
