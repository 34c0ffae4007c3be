#include <functional>
#include <gtest/gtest.h>
#include <thread>
#include <type_traits>
#include <vector>

#include <beeline/internal/budget_meter.h>

#include "ended_budget.h"
#include "refusal.h"

namespace beeline::internal {
namespace {

TEST(Budget, IsUnlimitedByDefault) {
  const Budget budget;
  BudgetMeter meter(budget);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(meter.ended(1'000'000'000'000));
  EXPECT_EQ(meter.ending(), Ending::complete);
}

TEST(Budget, EndsAfterTheLastUnitOfWork) {
  for (const std::int64_t work : {0, 1, 7}) {
    const Budget budget{.max_work = work};
    BudgetMeter meter(budget);
    for (std::int64_t i = 0; i < work; ++i) EXPECT_FALSE(meter.ended());
    EXPECT_TRUE(meter.complete());
    EXPECT_TRUE(meter.ended());
    EXPECT_EQ(meter.ending(), Ending::work_limit);
    EXPECT_TRUE(meter.ended(0));  // from now on
  }
}

TEST(Budget, TimeZeroEndsAtTheFirstQuestion) {
  const Budget budget{.time_limit = 0};
  BudgetMeter meter(budget);
  EXPECT_TRUE(meter.complete());
  EXPECT_TRUE(meter.ended());
  EXPECT_EQ(meter.ending(), Ending::time_limit);
  for (const double long_time : {3600.0, 1e300, std::numeric_limits<double>::infinity()}) {
    const Budget ample{.time_limit = long_time};
    EXPECT_FALSE(BudgetMeter(ample).ended());
  }
}

TEST(Budget, StaysCancelled) {
  bool wanted = false;
  const Budget budget{.cancelled = [&] { return wanted; }};
  BudgetMeter meter(budget);
  EXPECT_FALSE(meter.ended());
  wanted = true;
  EXPECT_TRUE(meter.ended());
  wanted = false;
  EXPECT_TRUE(meter.ended());
  EXPECT_EQ(meter.ending(), Ending::cancelled);
}

TEST(Budget, APartSpendsTheBudgetOfTheWhole) {
  const Budget budget{.max_work = 5};
  BudgetMeter whole(budget);
  const Budget shared = whole.part();
  BudgetMeter first(shared);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(first.ended());
  Budget less = whole.part();
  less.max_work = 1;
  BudgetMeter second(less);
  EXPECT_FALSE(second.ended());
  EXPECT_TRUE(second.ended());  // its own limit
  EXPECT_EQ(second.ending(), Ending::work_limit);
  EXPECT_TRUE(whole.complete());
  EXPECT_TRUE(first.ended());
  EXPECT_EQ(first.ending(), Ending::work_limit);
  EXPECT_EQ(whole.ending(), Ending::work_limit);
  const Budget late = whole.part();
  EXPECT_TRUE(BudgetMeter(late).ended());
}

TEST(Budget, CountsTheWorkOfAllThreads) {
  constexpr int threads = 4, each = 10'000;
  const Budget budget{.max_work = threads * each / 2};
  BudgetMeter meter(budget);
  std::atomic<int> done = 0;
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) {
    workers.emplace_back([&] {
      for (int k = 0; k < each && !meter.ended(); ++k) ++done;
    });
  }
  for (std::thread& worker : workers) worker.join();
  EXPECT_EQ(done, threads * each / 2);
  EXPECT_EQ(meter.ending(), Ending::work_limit);
}

TEST(Budget, ReportsProgressOfItsOwn) {
  double reported = -1;
  const Budget budget{.progress = [&](double fraction) { reported = fraction; }};
  BudgetMeter meter(budget);
  meter.report(0.25);
  EXPECT_EQ(reported, 0.25);
  const Budget part = meter.part();
  BudgetMeter(part).report(0.75);
  EXPECT_EQ(reported, 0.25);
}

TEST(Budget, APartReportsItsFractionOfTheWhole) {
  std::vector<double> reported;
  const Budget budget{.progress = [&](double fraction) { reported.push_back(fraction); }};
  BudgetMeter meter(budget);
  const Budget half = meter.part(0.5, 1);
  BudgetMeter part(half);
  for (const double fraction : {0.0, 0.5, 0.25, 0.5, 1.0}) part.report(fraction);
  EXPECT_EQ(reported, (std::vector<double>{0.5, 0.75, 1}));
}

template <class Work>
void in_four_threads(const Work& work) {
  std::vector<std::thread> workers;
  for (int i = 0; i < 4; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
}

TEST(Budget, ThreadsReportOneAfterTheOther) {
  constexpr int each = 2000;
  testing::Reports reports;
  const Budget budget{.progress = std::ref(reports)};
  BudgetMeter meter(budget);
  const Budget first = meter.part(0, 0.5), second = meter.part(0.5, 1);
  for (const Budget& half : {first, second}) {
    BudgetMeter part(half);
    std::atomic<int> done = 0;
    in_four_threads([&] {
      for (int k = 0; k < each; ++k) part.report(++done / (4.0 * each));
    });
  }
  EXPECT_EQ(reports.last, 1);
  EXPECT_GT(reports.calls, 2);
}

TEST(FinishedSteps, ThreadsReportEachHundredthOnce) {
  constexpr int all = 4 * 5000;
  testing::Reports reports;
  const Budget budget{.progress = std::ref(reports)};
  BudgetMeter meter(budget);
  FinishedSteps finished(meter, all);
  in_four_threads([&] {
    for (int k = 0; k < all / 4; ++k) finished.add(1);
  });
  EXPECT_EQ(finished.count(), all);
  EXPECT_EQ(reports.last, 1);
  EXPECT_LE(reports.calls, 100);
}

// Only the library makes a budget that is a part of another: what a user can name is empty.
static_assert(std::is_default_constructible_v<WholeComputation>);
static_assert(!std::is_constructible_v<WholeComputation, BudgetMeter&>);
static_assert(std::is_aggregate_v<Budget>);

TEST(Budget, RefusesNegativeLimits) {
  const auto made = [](const Budget& budget) { BudgetMeter meter(budget); };
  EXPECT_REFUSED(made({.time_limit = -1e-9}), "time_limit");
  EXPECT_REFUSED(made({.time_limit = std::nan("")}), "time_limit");
  EXPECT_REFUSED(made({.max_work = -1}), "max_work");
}

TEST(Budget, NamesItsEndings) {
  EXPECT_EQ(name(Ending::complete), "complete");
  EXPECT_EQ(name(Ending::time_limit), "time_limit");
  EXPECT_EQ(name(Ending::cancelled), "cancelled");
  EXPECT_EQ(name(Ending::work_limit), "work_limit");
}

}  // namespace
}  // namespace beeline::internal
