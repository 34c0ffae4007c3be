#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/math/decompositions.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/internal/null_space.h>

#include <tests/path/random_line.h>

namespace beeline::internal {
namespace {

Pose a_little_away(testing::Random& random, const Pose& from, double way) {
  Pose to = from;
  to.translation() += way * random.direction();
  to.linear() = so3_exp(way * random.direction()) * from.linear();
  return to;
}

// The error after one Gauss-Newton step is of second order if the Jacobian is regular.
TEST(PredictConfiguration, BringsTheToolNextToTheTarget) {
  testing::Random random;
  for (const std::string name : {"panda", "ur5", "stanford"}) {
    const Arm arm = built_in(name);
    int regular = 0;
    for (int i = 0; i < 200; ++i) {
      const Configuration q = testing::inner_configuration(random, arm);
      const double way = 1e-4;
      const Pose to = a_little_away(random, forward_kinematics(arm, q), way);
      const double smallest =
          Eigen::JacobiSVD<Eigen::MatrixXd>(task_jacobian(arm, q, Task::spatial()))
              .singularValues()
              .minCoeff();
      if (smallest < 0.02) continue;
      ++regular;
      const Configuration next = predict_configuration(arm, q, to, Task::spatial(), bounds_of(arm));
      const double step = (next - q).norm();
      ASSERT_LT(step, 15 * way / smallest) << name;
      const Eigen::VectorXd left = task_error(Task::spatial(), to, forward_kinematics(arm, next));
      ASSERT_LT(left.norm(), 0.05 * way + 2 * step * step) << name;
    }
    EXPECT_GT(regular, 100) << name;
  }
}

TEST(PredictConfiguration, StaysWithinTheBounds) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Bounds bounds = bounds_of(arm);
  for (int i = 0; i < 500; ++i) {
    Configuration q = random.configuration(arm);
    const int k = random.integer(0, 6);
    q[k] = i % 2 == 0 ? bounds.lower[k] : bounds.upper[k];
    const Pose to = a_little_away(random, forward_kinematics(arm, q), random.uniform(0, 0.5));
    const Configuration next = predict_configuration(arm, q, to, Task::spatial(), bounds);
    ASSERT_TRUE(next.allFinite());
    ASSERT_TRUE(limit_violations(arm, next, 0).empty());
  }
}

TEST(PredictConfiguration, StaysAtRestWhereTheToolIsAtTheTarget) {
  testing::Random random;
  const Arm arm = built_in("iiwa14");
  const Configuration q = random.configuration(arm);
  const Configuration next =
      predict_configuration(arm, q, forward_kinematics(arm, q), Task::spatial(), bounds_of(arm));
  EXPECT_LT((next - q).norm(), 1e-9);
}

// With and without limits, the same target: the joint near its limit ends farther inside.
TEST(PredictConfiguration, DrivesARedundantJointFromItsLimit) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Bounds bounds = bounds_of(arm);
  int inside = 0, cases = 0;
  for (int i = 0; i < 300; ++i) {
    Configuration q = testing::inner_configuration(random, arm);
    const int k = random.integer(0, 6);
    q[k] = bounds.upper[k] - 0.02 * (bounds.upper[k] - bounds.lower[k]);
    const Pose to = a_little_away(random, forward_kinematics(arm, q), 1e-4);
    const double with = predict_configuration(arm, q, to, Task::spatial(), bounds)[k];
    const double without = predict_configuration(arm, q, to, Task::spatial(), no_bounds(arm))[k];
    if (std::abs(with - without) < 1e-9) continue;  // no freedom to move this joint
    ++cases;
    inside += with < without ? 1 : 0;
  }
  EXPECT_GT(cases, 100);
  EXPECT_GT(inside, 0.9 * cases);
}

}  // namespace
}  // namespace beeline::internal
