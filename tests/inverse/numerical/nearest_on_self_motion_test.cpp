#include <gtest/gtest.h>

#include <beeline/inverse/numerical/nearest_on_self_motion.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/decompositions.h>
#include <beeline/model/catalog.h>

#include <hwy/targets.h>

#include <tests/random.h>

namespace beeline {
namespace {

using namespace internal;

Configuration radians_of(const GaussNewtonState& near) {  // the arms here have revolute joints only
  return Eigen::Map<const Configuration>(near.q.data(), std::ssize(near.q));
}

/// At the minimum the self-motion does not change the distance, unless a joint is at its bound.
TEST(NearestOnSelfMotion, IsALocalMinimumOfTheDistance) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa14", "gen3"}) {
    const Arm arm = built_in(name);
    const Bounds bounds = bounds_of(arm);
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds);
    GaussNewtonState near;
    int minima = 0, solved = 0;
    for (int i = 0; i < testing::cases(1500); ++i) {
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      Configuration start = q, weights(arm.dof());
      for (double& value : start) value += random.uniform(-0.3, 0.3);
      for (double& weight : weights) weight = random.uniform(0.2, 5);
      if (!gauss_newton(problem, pose, q.data(), {}, near)) continue;
      const Configuration from = radians_of(near);
      if (!approach_start(problem, pose, start.data(), weights.data(), {}, near)) continue;
      ++solved;
      const Configuration found = radians_of(near), away = found - start;
      EXPECT_TRUE(forward_kinematics(arm, found).isApprox(pose, 1e-9)) << name;
      EXPECT_TRUE(within(bounds, found)) << name;
      const double before = weights.dot((from - start).cwiseAbs2());
      const double square = weights.dot(away.cwiseAbs2());
      EXPECT_LE(square, before * (1 + 1e-9)) << name;
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian(arm, found), Eigen::ComputeFullV);
      const Configuration tangent = svd.matrixV().rightCols<1>();
      const double slope = tangent.dot(weights.cwiseProduct(away)) / std::sqrt(square);
      const bool at_bound =
          (found - bounds.lower).minCoeff() < 1e-9 || (bounds.upper - found).minCoeff() < 1e-9;
      minima += at_bound || std::abs(slope) < 0.05;
    }
    EXPECT_GE(solved, testing::cases(1400)) << name;
    EXPECT_GE(minima, 0.97 * solved) << name;  // others need more steps
  }
}

TEST(NearestOnSelfMotion, IsTheSameOnEveryMachine) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
  const Configuration weights = Configuration::Ones(arm.dof());
  GaussNewtonState first, other;
  for (int i = 0; i < 100; ++i) {
    const Configuration start = random.configuration(arm);
    Pose pose = forward_kinematics(arm, start);
    pose.translation() += 0.005 * random.direction();
    if (!gauss_newton(problem, pose, start.data(), {}, first)) continue;
    const bool solved = approach_start(problem, pose, start.data(), weights.data(), {}, first);
    const double distance = (radians_of(first) - start).norm();
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      EXPECT_TRUE(gauss_newton(problem, pose, start.data(), {}, other));
      EXPECT_EQ(approach_start(problem, pose, start.data(), weights.data(), {}, other), solved);
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_NEAR((radians_of(other) - start).norm(), distance, 1e-3 * distance);
    }
  }
}

}  // namespace
}  // namespace beeline
