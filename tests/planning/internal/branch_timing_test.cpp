#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/planning/internal/branch_timing.h>

#include <tests/planning/random_branch.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::RandomBranch;

constexpr Deviation plan_tolerance{1e-5, 1e-5};

/// Calls check(random branch, its timing) for `count` branches; every second segment ends in a stop
/// in a third of them.
template <class Check>
void for_random_plans(int count, const RetimeOptions& options, const Check& check) {
  Random random;
  constexpr const char* arms[] = {"puma560", "ur5", "panda", "rrr"};
  for (int found = 0, tried = 0; found < count; ++tried) {
    ASSERT_LT(tried, 50 * count) << "few paths are possible";
    auto made = testing::random_branch(random, arms[tried % 4], {1e-3, 1e-3});
    if (!made) continue;
    for (std::size_t i = 0; i < made->route.stops.size() && tried % 3 == 0; i += 2) {
      made->route.stops[i] = true;
    }
    Budget budget;
    BudgetMeter meter(budget);
    const MotionRequest request{made->arm,   std::nullopt,
                                made->route, {.task = made->task},
                                options,     {.tolerance = 1e-3, .orientation_tolerance = 1e-3}};
    BranchTiming timing(request, made->branch, 16, meter);
    if (timing.sample(options.rate).status != MotionStatus::reached) continue;
    ++found;
    check(*made, timing, random);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

/// The parameters never decrease, and the tool is at the path's pose there at each sample.
void expect_parameters(const RandomBranch& made, const TimedBranch& plan) {
  const auto& s = plan.path_parameters;
  ASSERT_EQ(s.size(), plan.trajectory.size());
  ASSERT_EQ(s.front(), 0);
  ASSERT_EQ(s.back(), double(made.route.path.segments.size()));
  for (std::size_t k = 0; k < s.size(); ++k) {
    if (k > 0) {
      ASSERT_GE(s[k], s[k - 1]);
    }
    const Pose tool = forward_kinematics(made.arm, plan.trajectory.positions[k]);
    const Deviation off = task_deviation(made.task, pose_at(made.route.path, s[k]), tool);
    ASSERT_LE(off.position, 2 * plan_tolerance.position) << "sample " << k << ", s = " << s[k];
    ASSERT_LE(off.orientation, 2 * plan_tolerance.orientation);
  }
}

TEST(BranchTiming, PathParametersNeverDecreaseAndAreThoseOfTheSamples) {
  for (const double rate : {0.0, 100.0}) {
    for_random_plans(testing::cases(15), {.rate = rate},
                     [rate](const RandomBranch& made, BranchTiming& timing, Random&) {
                       expect_parameters(made, timing.sample(rate));
                     });
  }
}

// A rate with too many samples is no reason against another rate.
TEST(BranchTiming, EachRateHasAStatusOfItsOwn) {
  const RetimeOptions few{.max_samples = 100};
  for_random_plans(testing::cases(10), few,
                   [](const RandomBranch& made, BranchTiming& timing, Random&) {
                     const double duration = timing.sample(0).trajectory.times.back();
                     const TimedBranch dense = timing.sample(1000 / duration);
                     EXPECT_EQ(dense.status, MotionStatus::too_many_samples);
                     EXPECT_TRUE(dense.reason);
                     EXPECT_EQ(dense.trajectory.size(), 0);
                     const TimedBranch sparse = timing.sample(20 / duration);
                     EXPECT_EQ(sparse.status, MotionStatus::reached) << sparse.reason;
                     EXPECT_FALSE(sparse.reason);
                     expect_parameters(made, sparse);
                   });
}

TEST(BranchTiming, DivideAddsTheSamplesAskedForAndKeepsTheEndsOfSegments) {
  for_random_plans(
      testing::cases(20), {}, [&](const RandomBranch& made, BranchTiming& timing, Random& random) {
        const TimedBranch before = timing.sample(0);
        std::vector<int> times(before.trajectory.size() - 1, 1);
        for (int& parts : times) parts = random.integer(0, 3) == 0 ? random.integer(2, 4) : 1;
        timing.divide(times);
        const TimedBranch after = timing.sample(0);
        ASSERT_NO_FATAL_FAILURE(expect_parameters(made, after));
        const auto& s = after.path_parameters;
        const auto between = [&](double a, double b) {  // samples
          constexpr double rounding = 1e-7;
          return std::count_if(s.begin(), s.end(),
                               [&](double x) { return x > a + rounding && x < b - rounding; });
        };
        for (std::size_t k = 0; k < times.size(); ++k) {
          const double a = before.path_parameters[k], b = before.path_parameters[k + 1];
          ASSERT_GE(between(a, b), times[k] - 1) << "after sample " << k;
        }
        for (std::size_t i = 0; i <= made.route.path.segments.size(); ++i) {
          ASSERT_TRUE(std::any_of(s.begin(), s.end(),
                                  [&](double x) { return std::abs(x - double(i)) < 1e-7; }))
              << "the end of segment " << i;
        }
      });
}

}  // namespace
}  // namespace beeline::internal
