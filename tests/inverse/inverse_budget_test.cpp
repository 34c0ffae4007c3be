#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include "../ended_budget.h"
#include "../random.h"

#include <tests/reason.h>

namespace beeline {
namespace {

struct Problem {
  std::string what;
  Arm arm;
  Pose pose;
  InverseOptions options;
};

/// Requests that pass through every stage: closed forms, searches, redundancy, diagnosis.
std::vector<Problem> problems(testing::Random& random) {
  std::vector<Problem> all;
  const auto add = [&](const std::string& what, const std::string& arm, InverseOptions options,
                       const Vector3& moved = Vector3::Zero()) {
    const Arm made = built_in(arm);
    Pose pose = forward_kinematics(made, random.configuration(made));
    pose.translation() += moved;
    all.push_back({what, made, pose, std::move(options)});
  };
  add("closed form, all", "ur5", {.all = true});
  add("search, all", "ur5", {.method = InverseMethod::numerical, .all = true, .max_restarts = 24});
  add("search", "iiwa14", {.method = InverseMethod::numerical});
  add("grid, all", "panda", {.all = true, .grid = 12});
  add("nearest", "panda", {.redundancy = Redundancy::nearest, .grid = 6});
  add("centred", "panda", {.redundancy = Redundancy::centred, .grid = 6});
  add("nearest by search", "panda",
      {.method = InverseMethod::numerical, .redundancy = Redundancy::nearest});
  add("locked", "panda", {.seed = Configuration{{0, -0.8, 0, -2.4, 0, 1.6, 0.8}}, .lock = 6});
  add("position of a redundant arm", "panda", {.task = Task::position(), .all = true});
  add("beyond the reach", "panda", {}, {5, 0, 0});
  add("hardly beyond the reach", "puma560", {}, {0.7, 0.7, 0});
  add("outside the limits", "stanford", {}, {0.4, 0.4, 0});
  return all;
}

void expect_same(const InverseResult& a, const InverseResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.solutions, b.solutions);
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.restarts, b.restarts);
}

void expect_true(const Problem& problem, const InverseResult& result) {
  const Task task = problem.options.task.value_or(Task::spatial());
  for (const Configuration& q : result.solutions) {
    const Deviation error = task_deviation(task, problem.pose, forward_kinematics(problem.arm, q));
    EXPECT_LE(std::max(error.position, error.orientation), 1e-9);
    EXPECT_TRUE(limit_violations(problem.arm, q).empty());
  }
  EXPECT_EQ(result.nearest || result.unexplained, result.solutions.empty());
}

/// A result of a search that was cancelled: either the same answer, or the status and no claim.
void expect_ended(const Problem& problem, const InverseResult& result, const InverseResult& whole) {
  expect_true(problem, result);
  if (result.status != InverseStatus::cancelled) {
    EXPECT_EQ(result.status, whole.status);
    EXPECT_FALSE(problem.options.all && result.status == InverseStatus::solved);
    return;
  }
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result);
  EXPECT_EQ(testing::field<Ending>(result.reason, ReasonField::ending), Ending::cancelled);
}

TEST(InverseBudget, CancelledAnywhereItClaimsNothing) {
  testing::Random random;
  int searches = 0;
  for (const Problem& problem : problems(random)) {
    SCOPED_TRACE(problem.what);
    const InverseResult whole = inverse_kinematics(problem.arm, problem.pose, problem.options);
    std::size_t found = 0;
    int ended = 0;
    testing::for_each_cancellation(testing::cases(300), [&](int n) {
      SCOPED_TRACE("cancelled at question " + std::to_string(n));
      testing::CancelAt cancel(n);
      InverseOptions options = problem.options;
      options.budget = cancel.budget();
      const InverseResult result = inverse_kinematics(problem.arm, problem.pose, options);
      if (!cancel.cancelled()) {
        expect_same(result, whole);
        return false;
      }
      expect_ended(problem, result, whole);
      EXPECT_TRUE(!problem.options.all || result.solutions.size() >= found);
      found = result.solutions.size();
      ++ended;
      return !::testing::Test::HasFailure();
    });
    searches += ended > 0 ? 1 : 0;
    EXPECT_LE(found, std::max<std::size_t>(whole.solutions.size(), 1));
  }
  EXPECT_GE(searches, 6);  // the others are answered by formulas
}

TEST(InverseBudget, EndsAtOnce) {
  testing::Random random;
  for (const Problem& problem : problems(random)) {
    SCOPED_TRACE(problem.what);
    const InverseResult whole = inverse_kinematics(problem.arm, problem.pose, problem.options);
    InverseOptions options = problem.options;
    options.budget = {.time_limit = 0};
    const InverseResult timed = inverse_kinematics(problem.arm, problem.pose, options);
    options.budget = {.max_work = 0};
    const InverseResult worked = inverse_kinematics(problem.arm, problem.pose, options);
    expect_true(problem, timed);
    expect_true(problem, worked);
    EXPECT_EQ(timed.solutions, worked.solutions);
    EXPECT_TRUE(timed.status == whole.status || timed.status == InverseStatus::time_limit);
    EXPECT_TRUE(worked.status == whole.status || worked.status == InverseStatus::work_limit);
  }
}

TEST(InverseBudget, WorkEndsTheSameOnEveryCall) {
  testing::Random random;
  for (const Problem& problem : problems(random)) {
    SCOPED_TRACE(problem.what);
    for (const std::int64_t work : {0, 5, 40, 300}) {
      InverseOptions options = problem.options;
      options.budget.max_work = work;
      const InverseResult first = inverse_kinematics(problem.arm, problem.pose, options);
      inverse_kinematics(problem.arm, problem.pose, problem.options);
      expect_same(first, inverse_kinematics(problem.arm, problem.pose, options));
    }
  }
}

TEST(InverseBudget, AnAmpleOneChangesNothing) {
  testing::Random random;
  for (const Problem& problem : problems(random)) {
    SCOPED_TRACE(problem.what);
    InverseOptions options = problem.options;
    options.budget = {
        .time_limit = 1e6, .max_work = 1'000'000'000, .cancelled = [] { return false; }};
    expect_same(inverse_kinematics(problem.arm, problem.pose, options),
                inverse_kinematics(problem.arm, problem.pose, problem.options));
    const int dof = problem.arm.dof();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(dof, 8), b = a;
    const Configuration seed = problem.options.seed.value_or(middle_configuration(problem.arm));
    EXPECT_EQ(inverse_kinematics(problem.arm, problem.pose, seed, a, options),
              inverse_kinematics(problem.arm, problem.pose, seed, b, problem.options));
    EXPECT_EQ(a, b);
  }
}

}  // namespace
}  // namespace beeline
