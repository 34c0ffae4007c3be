#include <gtest/gtest.h>

#include <beeline/inverse/numerical/gauss_newton.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <hwy/targets.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using namespace internal;

/// A run from a nearby start, and what must hold when it converges.
bool arrives(const Arm& arm, const NumericalProblem& problem, const Configuration& q,
             const Configuration& start, const LaneOptions& options, double tolerance,
             GaussNewtonState& near) {
  const Pose pose = forward_kinematics(arm, q);
  if (!gauss_newton(problem, pose, start.data(), options, near)) return false;
  Configuration at(q.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    at[k] = near.q[i] * problem.coordinates[i].unit;
  }
  EXPECT_TRUE(within(problem.bounds, at)) << arm.name() << ' ' << at.transpose();
  const Pose seen = forward_kinematics(arm, at);
  const Deviation left = task_deviation(Task::spatial(), pose, seen);
  EXPECT_LE(left.position, tolerance) << arm.name();
  EXPECT_LE(left.orientation, tolerance) << arm.name();
  const Vector3 said(near.error[0], near.error[1], near.error[2]);
  EXPECT_NEAR(said.norm() * problem.length, left.position, 1e-11 * problem.length);
  return true;
}

Configuration nearby(const Configuration& q, double size, testing::Random& random) {
  Configuration start = q;
  for (double& coordinate : start) coordinate += random.uniform(-size, size);
  return start;
}

TEST(DescentNear, TracksEveryBuiltInArm) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
    GaussNewtonState near;
    int arrived = 0, steps = 0;
    for (int i = 0; i < 500; ++i) {
      const Configuration q = random.configuration(arm);
      const Configuration start = nearby(q, 0.1, random);
      if (arrives(arm, problem, q, start, {.tolerance = 1e-6, .polish = false}, 1e-6 + 1e-12,
                  near)) {
        ++arrived;
        steps += near.iterations;
      }
    }
    EXPECT_GE(arrived, 460) << name;
    EXPECT_LE(steps, 3.2 * arrived) << name;
  }
}

TEST(DescentNear, PolishesToRoundingLevel) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), no_bounds(arm));
    GaussNewtonState near;
    int arrived = 0;
    for (int i = 0; i < 200; ++i) {
      const Configuration q = random.configuration(arm);
      arrived += arrives(arm, problem, q, nearby(q, 0.02, random), {.tolerance = 1e-9}, 1e-9, near);
    }
    EXPECT_GE(arrived, 190) << name;
  }
}

TEST(DescentNear, TracksJointsOfAllKindsAndFollowers) {
  testing::Random random;
  for (int joints = 1; joints <= 40; ++joints) {
    const Arm arm = testing::random_arm(random, joints, joints % 2 == 0 ? 3 : 0);
    const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
    GaussNewtonState near;
    int arrived = 0;
    for (int i = 0; i < 20; ++i) {
      const Configuration q = random.configuration(arm);
      arrived += arrives(arm, problem, q, nearby(q, 0.01, random), {.tolerance = 1e-8}, 1e-8, near);
    }
    EXPECT_GE(arrived, 14) << joints;
  }
}

TEST(DescentNear, SaysNoWhereItDoesNotFitAndNeverArrivesWrongly) {
  testing::Random random;
  const Arm arm = built_in("panda");
  GaussNewtonState near;
  const Configuration q = Configuration::Zero(7);
  const NumericalProblem part = numerical_problem(arm, Task::position(), no_bounds(arm));
  EXPECT_FALSE(gauss_newton(part, forward_kinematics(arm, q), q.data(), {}, near));
  const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
  for (int i = 0; i < 2000; ++i) {
    const double far = std::pow(10.0, random.uniform(-3, 6));
    arrives(arm, problem, random.configuration(arm), nearby(random.configuration(arm), far, random),
            {}, 1e-10 + 1e-13, near);
    const Pose beyond = random.pose(far + 3);
    if (beyond.translation().norm() < 2) continue;
    EXPECT_FALSE(gauss_newton(problem, beyond, q.data(), {}, near));
  }
}

TEST(DescentNear, EveryMachineArrivesAlike) {
  testing::Random random;
  const Arm arm = built_in("iiwa14");
  const NumericalProblem problem = numerical_problem(arm, Task::spatial(), bounds_of(arm));
  GaussNewtonState first, other;
  for (int i = 0; i < 100; ++i) {
    const Configuration q = random.configuration(arm), start = nearby(q, 0.02, random);
    const bool arrived = arrives(arm, problem, q, start, {}, 1e-10, first);
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      EXPECT_EQ(arrives(arm, problem, q, start, {}, 1e-10, other), arrived)
          << hwy::TargetName(target);
      hwy::SetSupportedTargetsForTest(0);
      if (!arrived) continue;
      for (std::size_t k = 0; k < first.q.size(); ++k) EXPECT_NEAR(other.q[k], first.q[k], 1e-7);
    }
  }
}

}  // namespace
}  // namespace beeline
