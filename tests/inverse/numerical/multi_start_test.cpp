#include <gtest/gtest.h>

#include <beeline/error.h>
#include <beeline/inverse/numerical/multi_start.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using namespace internal;

/// An arm with its problem, seeds and buffers.
struct Solver {
  Arm arm;
  NumericalProblem problem;
  SeedTable seeds;
  MultiStartBuffers buffers;
  SearchResult result;

  Solver(const Arm& arm, const Task& task, const Bounds& bounds)
      : arm(arm),
        problem(numerical_problem(arm, task, bounds)),
        seeds(seed_table(problem, 7, 32)) {}

  const SearchResult& operator()(const Pose& pose, const Configuration& start,
                                 const MultiStartOptions& options = {}) {
    multi_start({arm, problem, seeds}, pose, start, options, buffers, result);
    return result;
  }
};

void expect_solved(const Solver& solver, const Pose& pose, double tolerance) {
  const Arm& arm = solver.arm;
  ASSERT_FALSE(solver.result.solutions.empty()) << arm.name();
  for (const Configuration& q : solver.result.solutions) {
    EXPECT_TRUE(within(solver.problem.bounds, q)) << arm.name() << ' ' << q.transpose();
    const Deviation left = task_deviation(solver.problem.task, pose, forward_kinematics(arm, q));
    EXPECT_LE(left.position, tolerance);
    EXPECT_LE(left.orientation, tolerance);
  }
}

TEST(MultiStart, SolvesWhatIsWithinLimitsToRoundingLevel) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    Solver solve(arm, default_task(arm), bounds_of(arm));
    const Configuration start = middle_configuration(arm);
    int fine = 0;
    for (int i = 0; i < 500; ++i) {
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const SearchResult& result = solve(pose, start, {.tolerance = 1e-6});
      expect_solved(solve, pose, 1e-6 + 1e-12);
      fine += result.nearest.error.position < 1e-10 && result.nearest.error.orientation < 1e-10;
      ASSERT_EQ(result.solutions.size(), 1u) << name;
      EXPECT_TRUE(result.nearest.converged);
      EXPECT_EQ(result.nearest.q, result.solutions[0]);
    }
    EXPECT_GE(fine, 499) << name;  // a local minimum next to a singularity may be within tolerance
  }
}

TEST(MultiStart, SolvesArmsOfAllKindsOfJoints) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), 3);
    Solver solve(arm, Task::spatial(), bounds_of(arm));
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    solve(pose, random.configuration(arm));
    expect_solved(solve, pose, 1e-9);
  }
}

TEST(MultiStart, StaysWithTheStartsBranchFromNearby) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  Solver solve(arm, Task::spatial(), bounds_of(arm));
  int same = 0;
  for (int i = 0; i < 500; ++i) {
    const Configuration q = random.configuration(arm);
    Configuration start = q;
    for (double& angle : start) angle += random.uniform(-0.02, 0.02);
    solve(forward_kinematics(arm, q), start);
    ASSERT_EQ(solve.result.solutions.size(), 1u);
    same += (solve.result.solutions[0] - q).cwiseAbs().maxCoeff() < 0.1;
  }
  EXPECT_GE(same, 485);  // next to a singularity it may converge to the other branch
}

TEST(MultiStart, AllFindsTheEightBranches) {
  testing::Random random;
  const Arm arm = built_in("puma560");
  Solver solve(arm, Task::spatial(), no_bounds(arm));
  for (int i = 0; i < 20; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const SearchResult& result =
        solve(pose, middle_configuration(arm), {.max_restarts = 2000, .all = true});
    expect_solved(solve, pose, 1e-9);
    EXPECT_EQ(result.restarts, 2000);
    EXPECT_GE(result.solutions.size(), 4u);
    EXPECT_LE(result.solutions.size(), 8u);
    for (std::size_t a = 0; a < result.solutions.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_FALSE(same_posture(arm, result.solutions[a], result.solutions[b]));
      }
    }
  }
}

TEST(MultiStart, ComesAtTheTurnNearestToTheStart) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (const Bounds& bounds : {bounds_of(arm), no_bounds(arm)}) {
    Solver solve(arm, Task::spatial(), bounds);
    for (int i = 0; i < 200; ++i) {
      const Configuration start = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      solve(pose, start);
      expect_solved(solve, pose, 1e-9);
      const Configuration& q = solve.result.solutions[0];
      EXPECT_LT((q - nearest_representative(arm, q, start, bounds)).norm(), 1e-12);
    }
  }
}

TEST(MultiStart, TheSameSeedGivesTheSameAnswerWhateverWasBefore) {
  testing::Random random;
  const Arm arm = built_in("panda");
  Solver used(arm, Task::spatial(), bounds_of(arm));
  for (int i = 0; i < 100; ++i) {
    const Configuration start = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const bool all = i % 10 == 0;
    const MultiStartOptions options{.max_restarts = 100, .all = all, .random_seed = 5};
    Solver fresh(arm, Task::spatial(), bounds_of(arm));
    used(pose, start, options);
    fresh(pose, start, options);
    EXPECT_EQ(used.result.solutions, fresh.result.solutions);
    EXPECT_EQ(used.result.iterations, fresh.result.iterations);
    EXPECT_EQ(used.result.restarts, fresh.result.restarts);
  }
}

TEST(MultiStart, OutOfReachEndsWithTheNearest) {
  const Arm arm = built_in("ur5");
  Solver solve(arm, Task::spatial(), bounds_of(arm));
  const SearchResult& result =
      solve(make_pose({3, 0, 0}), Configuration::Zero(6), {.max_restarts = 30});
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_FALSE(result.nearest.converged);
  EXPECT_EQ(result.restarts, 30);
  EXPECT_TRUE(within(solve.problem.bounds, result.nearest.q));
  EXPECT_GT(result.nearest.error.position, 1);
  const Deviation seen = task_deviation(Task::spatial(), make_pose({3, 0, 0}),
                                        forward_kinematics(arm, result.nearest.q));
  EXPECT_NEAR(seen.position, result.nearest.error.position, 1e-12);
  EXPECT_NEAR(seen.orientation, result.nearest.error.orientation, 1e-12);
}

TEST(MultiStart, ATimeLimitEndsTheSearch) {
  const Arm arm = built_in("ur5");
  Solver solve(arm, Task::spatial(), bounds_of(arm));
  const Budget limit{.time_limit = 2e-3};
  BudgetMeter budget(limit);
  const MultiStartOptions options{.max_restarts = 1'000'000'000, .budget = budget};
  const SearchResult& result = solve(make_pose({3, 0, 0}), Configuration::Zero(6), options);
  EXPECT_TRUE(result.solutions.empty());
  EXPECT_LT(result.restarts, 1'000'000'000);
  EXPECT_EQ(budget.ending(), Ending::time_limit);
  EXPECT_EQ(result.nearest.q.size(), 6);
}

TEST(MultiStart, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("panda");
  Solver solve(arm, Task::spatial(), bounds_of(arm));
  const Configuration q = Configuration::Zero(7);
  EXPECT_THROW(solve(Pose::Identity(), Configuration::Zero(6)), Error);
  EXPECT_THROW(solve(Pose::Identity(), q * NAN), Error);
  EXPECT_THROW(solve(make_pose(Vector3(NAN, 0, 0)), q), Error);
  EXPECT_THROW(solve(Pose::Identity(), q, {.tolerance = -1}), Error);
  EXPECT_THROW(solve(Pose::Identity(), q, {.max_iterations = -1}), Error);
  EXPECT_THROW(solve(Pose::Identity(), q, {.max_restarts = -1}), Error);
  solve.seeds = {.blocks = 1, .tool = {}};
  EXPECT_THROW(solve(Pose::Identity(), q), Error);
}

}  // namespace
}  // namespace beeline
