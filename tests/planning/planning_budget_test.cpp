#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>

#include "../ended_budget.h"
#include "../random.h"

#include <tests/reason.h>

namespace beeline {
namespace {

struct Job {
  std::string what;
  Arm arm;
  std::optional<Configuration> start;
  std::vector<Pose> poses;  ///< the first is the start's, if there is one
  PathMotionOptions options;

  Route route() const { return route_of(lines_through(poses), PathKind::line); }
};

/// Moves the tool of the configuration by these steps.
Job job(const std::string& what, const std::string& arm, const Configuration& q,
        const std::vector<Vector3>& steps, bool starts, PathMotionOptions options = {}) {
  Job made{what, built_in(arm), std::nullopt, {}, std::move(options)};
  if (starts) made.start = q;
  made.poses = {forward_kinematics(made.arm, q)};
  for (const Vector3& step : steps) {
    made.poses.push_back(made.poses.back());
    made.poses.back().translation() += step;
  }
  return made;
}

std::vector<Job> jobs() {
  const Configuration rrr{{0.3, 1.2, 0.4}}, panda{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}};
  const Configuration ur5{{0.1, -1.2, 1.5, -1.8, -1.5, 0.2}};
  return {
      job("planar, from a start", "rrr", rrr, {{-1, 0.5, 0}, {0.5, 0.5, 0}}, true),
      job("planar, from anywhere", "rrr", rrr, {{-1, 0.5, 0}}, false,
          {.profile = Profile::fastest, .rate = 50}),
      job("six joints, from anywhere", "ur5", ur5, {{0.05, 0.1, 0.05}}, false),
      job("redundant", "panda", panda, {{0.05, 0.1, -0.05}}, true),
      job("not possible, with suggestions", "rrr", rrr, {{-1, 9, 0}}, true, {.suggest = true}),
      job("not possible, redundant", "panda", panda, {{0.5, 0.5, 0.1}}, true),
  };
}

/// The fractions that `work` reports, with the options of a search that tolerates 1e-5.
template <class Work>
std::vector<double> reported(const Work& work) {
  std::vector<double> fractions;
  BranchOptions options;
  options.tolerance = {1e-5, 1e-5};
  options.budget.progress = [&fractions](double done) { fractions.push_back(done); };
  work(options);
  return fractions;
}

TEST(PlanningBudget, ProgressOfSearchesNeverFalls) {
  for (const Job& each : jobs()) {
    SCOPED_TRACE(each.what);
    const ToolPath path = lines_through(each.poses);
    const auto started = [&](BranchOptions options) {
      options.task = default_task(each.arm);
      return options;
    };
    for (const std::vector<double>& fractions :
         {reported([&](const BranchOptions& given) { branch_map(each.arm, path, started(given)); }),
          reported([&](const BranchOptions& given) {
            nearby_path(each.arm, each.start, path, started(given), false);
          })}) {
      ASSERT_FALSE(fractions.empty());
      EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
      EXPECT_EQ(std::adjacent_find(fractions.begin(), fractions.end()), fractions.end());
      EXPECT_GE(fractions.front(), 0);
      EXPECT_LE(fractions.back(), 1);
    }
  }
}

/// Whether a status reports the end of a budget.
bool is_ended(MotionStatus status) { return status == MotionStatus::cancelled; }

TEST(PlanningBudget, AMotionIsReachedOrEnded) {
  for (const Job& each : jobs()) {
    SCOPED_TRACE(each.what);
    const PathMotion whole = move_along(each.arm, each.start, each.route(), each.options);
    int ended = 0;
    testing::for_each_cancellation(testing::cases(40), [&](int n) {
      SCOPED_TRACE("cancelled at question " + std::to_string(n));
      testing::CancelAt cancel(n);
      PathMotionOptions options = each.options;
      options.budget = cancel.budget();
      const PathMotion motion = move_along(each.arm, each.start, each.route(), options);
      EXPECT_GE(motion.path_parameter, 0);
      EXPECT_LE(motion.path_parameter, static_cast<double>(each.poses.size() - 1));
      if (!cancel.cancelled()) {
        EXPECT_EQ(motion.status, whole.status);
        EXPECT_EQ(motion.reason, whole.reason);
        EXPECT_EQ(motion.trajectory.times, whole.trajectory.times);
        EXPECT_EQ(motion.trajectory.positions, whole.trajectory.positions);
        EXPECT_EQ(motion.path_parameter, whole.path_parameter);
        return false;
      }
      // Suggestions may be cut off after the motion was found to be impossible.
      EXPECT_TRUE(is_ended(motion.status) || (motion.status == whole.status && !whole))
          << motion.status << ": " << motion.reason;
      const ReasonField ending =
          is_ended(motion.status) ? ReasonField::ending : ReasonField::search_ending;
      EXPECT_EQ(testing::field<Ending>(motion.reason, ending), Ending::cancelled) << motion.reason;
      EXPECT_EQ(motion.trajectory.size(), 0u);
      ++ended;
      return !::testing::Test::HasFailure();
    });
    EXPECT_GT(ended, 20);
  }
}

TEST(PlanningBudget, PlansAreThoseSoFar) {
  for (const Job& each : jobs()) {
    SCOPED_TRACE(each.what);
    BranchOptions options{.task = default_task(each.arm)};
    const ToolPath path = each.route().path;
    const std::vector<Branch> whole = branch_map(each.arm, path, options);
    std::size_t begun = 0;
    testing::for_each_cancellation(testing::cases(20), [&](int n) {
      SCOPED_TRACE("cancelled at question " + std::to_string(n));
      testing::CancelAt cancel(n);
      options.budget = cancel.budget();
      const std::vector<Branch> branches = branch_map(each.arm, path, options);
      EXPECT_LE(branches.size(), whole.size());
      EXPECT_TRUE(std::is_sorted(
          branches.begin(), branches.end(),
          [](const Branch& a, const Branch& b) { return a.path_parameter > b.path_parameter; }));
      std::size_t complete = 0;
      for (const Branch& branch : branches) {
        EXPECT_TRUE(branch || bool(branch.reason));
        complete += is_ended(branch.status) ? 0 : 1;
      }
      EXPECT_GE(complete, begun);
      begun = complete;
      return cancel.cancelled() && !::testing::Test::HasFailure();
    });
    EXPECT_EQ(begun, whole.size());
  }
}

TEST(PlanningBudget, WorkEndsTheSameOnEveryCall) {
  for (const Job& each : jobs()) {
    SCOPED_TRACE(each.what);
    for (const std::int64_t work : {0, 30, 200, 2000}) {
      PathMotionOptions options = each.options;
      options.budget.max_work = work;
      const PathMotion a = move_along(each.arm, each.start, each.route(), options);
      const PathMotion b = move_along(each.arm, each.start, each.route(), options);
      EXPECT_EQ(a.status, b.status);
      EXPECT_EQ(a.reason, b.reason);
      EXPECT_EQ(a.path_parameter, b.path_parameter);
      EXPECT_EQ(a.trajectory.positions, b.trajectory.positions);
    }
    PathMotionOptions options = each.options;
    options.budget.time_limit = 0;
    EXPECT_EQ(move_along(each.arm, each.start, each.route(), options).status,
              MotionStatus::time_limit);
  }
}

TEST(PlanningBudget, NothingIsVerifiedThatIsNotChecked) {
  const Job each = jobs().front();
  const PathMotion motion = move_along(each.arm, each.start, each.route(), each.options);
  ASSERT_TRUE(motion) << motion.reason;
  for (const bool faulty : {false, true}) {
    Trajectory trajectory = motion.trajectory;
    if (faulty) trajectory.positions[trajectory.size() / 2][0] += 0.01;
    const Verification whole = verify(each.arm, trajectory, each.route());
    ASSERT_EQ(static_cast<bool>(whole), !faulty);
    testing::for_each_cancellation(testing::cases(1000), [&](int n) {
      testing::CancelAt cancel(n);
      const Verification part =
          verify(each.arm, trajectory, each.route(), {.budget = cancel.budget()});
      EXPECT_EQ(part.ending == Ending::cancelled, cancel.cancelled());
      EXPECT_EQ(static_cast<bool>(part), !faulty && !cancel.cancelled());
      EXPECT_EQ(!part.reason, static_cast<bool>(part));
      EXPECT_TRUE(faulty || part.fault == Fault::none);
      return cancel.cancelled() && !::testing::Test::HasFailure();
    });
  }
}

TEST(PlanningBudget, ADeviationIsBoundedOnlyAsAWhole) {
  const Job each = jobs().front();
  const PathMotion motion = move_along(each.arm, each.start, each.route(), each.options);
  const Task task = default_task(each.arm);
  testing::for_each_cancellation(testing::cases(1000), [&](int n) {
    testing::CancelAt cancel(n);
    const PathDeviation part = path_deviation(each.arm, motion.trajectory, motion.path_parameters,
                                              motion.path, task, cancel.budget());
    EXPECT_EQ(part.ending == Ending::cancelled, cancel.cancelled());
    EXPECT_EQ(std::isfinite(part.bound.position), !cancel.cancelled());
    EXPECT_EQ(std::isfinite(part.bound.orientation), !cancel.cancelled());
    EXPECT_LE(part.measured.position, motion.deviation.measured.position);
    return cancel.cancelled() && !::testing::Test::HasFailure();
  });
}

TEST(PlanningBudget, AProgramHasOneBudget) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0.3, 1.2, 0.4}};
  Program program;
  for (const auto& [kind, x] : {std::pair{MoveKind::line, -1.0}, std::pair{MoveKind::joint, 0.5},
                                std::pair{MoveKind::line, -0.5}}) {
    Move move{.kind = kind, .target = forward_kinematics(arm, start), .dwell = 0.1};
    move.target.translation().x() += x;
    program.moves.push_back(move);
  }
  const ProgramMotion whole = move_program(arm, start, program);
  ASSERT_TRUE(whole) << whole.reason;
  testing::for_each_cancellation(testing::cases(40), [&](int n) {
    SCOPED_TRACE("cancelled at question " + std::to_string(n));
    testing::CancelAt cancel(n);
    const ProgramMotion motion = move_program(arm, start, program, {.budget = cancel.budget()});
    EXPECT_EQ(motion.status, cancel.cancelled() ? MotionStatus::cancelled : MotionStatus::reached);
    EXPECT_EQ(motion.trajectory.positions,
              cancel.cancelled() ? std::vector<Configuration>() : whole.trajectory.positions);
    EXPECT_LE(motion.failed, program.moves.size());
    return cancel.cancelled() && !::testing::Test::HasFailure();
  });
  testing::for_each_cancellation(testing::cases(40), [&](int n) {
    testing::CancelAt cancel(n);
    const Verification part = verify(arm, whole.trajectory, program, {.budget = cancel.budget()});
    EXPECT_EQ(static_cast<bool>(part), !cancel.cancelled()) << part.reason;
    return cancel.cancelled() && !::testing::Test::HasFailure();
  });
}

}  // namespace
}  // namespace beeline
