#include <functional>
#include <gtest/gtest.h>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include "../ended_budget.h"
#include "../random.h"

namespace beeline {
namespace {

/// The number of columns without a NaN. Each of them equals the column of the whole batch; the
/// others are NaN in all rows.
Eigen::Index expect_part_of(const Eigen::MatrixXd& whole, const Eigen::MatrixXd& part) {
  Eigen::Index computed = 0;
  for (Eigen::Index i = 0; i < part.cols(); ++i) {
    if (part.col(i).array().isNaN().all()) continue;
    EXPECT_EQ(part.col(i), whole.col(i)) << i;
    ++computed;
  }
  return computed;
}

TEST(BatchBudget, ColumnsAreComputedOrNaN) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  constexpr Eigen::Index count = 20'000;
  Eigen::MatrixXd q(6, count);
  for (auto column : q.colwise()) column = random.configuration(arm);
  Eigen::MatrixXd whole(16, count), jacobians(36, count), no_poses(16, 0);
  EXPECT_EQ(batch_forward<double>(arm, q, whole).computed, count);
  EXPECT_EQ(batch_jacobian<double>(arm, q, jacobians, no_poses).computed, count);
  for (int threads = 1; threads <= 4; ++threads) {
    for (const int n : {0, 1, 3, 10, 1000}) {
      SCOPED_TRACE(std::to_string(threads) + " threads, cancelled at question " +
                   std::to_string(n));
      Eigen::MatrixXd part(16, count), columns(36, count);
      testing::CancelAt cancel(n), again(n);
      const BatchResult result =
          batch_forward<double>(arm, q, part, {.threads = threads, .budget = cancel.budget()});
      EXPECT_EQ(result.ending == Ending::cancelled, cancel.cancelled());
      EXPECT_EQ(expect_part_of(whole, part), result.computed);
      EXPECT_EQ(result.computed == count, !cancel.cancelled());
      EXPECT_LE(result.computed, n * 1024);
      const BatchResult other = batch_jacobian<double>(
          arm, q, columns, no_poses, {.threads = threads, .budget = again.budget()});
      EXPECT_EQ(expect_part_of(jacobians, columns), other.computed);
    }
  }
}

TEST(BatchBudget, PosesAreSolvedOrNaN) {
  testing::Random random;
  for (const char* name : {"ur5", "panda"}) {
    const Arm arm = built_in(name);
    constexpr Eigen::Index count = 300;
    Eigen::MatrixXd goals(16, count), whole(arm.dof(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
      Pose pose = forward_kinematics(arm, random.configuration(arm));
      if (i % 50 == 49) pose.translation().x() += 10;
      goals.col(i) = pose.matrix().reshaped();
    }
    const Configuration seed = middle_configuration(arm);
    const BatchResult all = batch_inverse(arm, goals, seed, whole);
    EXPECT_EQ(all.computed, count);
    for (int threads = 1; threads <= 4; ++threads) {
      for (const int n : {0, 1, 20, 100, 250, 1'000'000}) {
        SCOPED_TRACE(std::to_string(threads) + " threads, cancelled at question " +
                     std::to_string(n));
        Eigen::MatrixXd part(arm.dof(), count);
        testing::CancelAt cancel(n);
        const BatchResult result = batch_inverse(arm, goals, seed, part, {},
                                                 {.threads = threads, .budget = cancel.budget()});
        EXPECT_EQ(result.ending == Ending::cancelled, cancel.cancelled());
        EXPECT_EQ(expect_part_of(whole, part), result.solved);
        EXPECT_LE(result.solved, result.computed);
        EXPECT_LE(result.computed, std::min<Eigen::Index>(count, n));
      }
    }
  }
}

TEST(BatchBudget, ThreadsReportProgressOneAfterTheOther) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  constexpr Eigen::Index count = 50'000, few = 400;
  Eigen::MatrixXd q(6, count), poses(16, count), found(6, few);
  for (auto column : q.colwise()) column = random.configuration(arm);
  for (int threads = 1; threads <= 4; ++threads) {
    testing::Reports rows, solutions;
    batch_forward<double>(arm, q, poses,
                          {.threads = threads, .budget = {.progress = std::ref(rows)}});
    EXPECT_EQ(rows.last, 1);
    EXPECT_GT(rows.calls, 20);
    batch_inverse(arm, poses.leftCols(few), middle_configuration(arm), found, {},
                  {.threads = threads, .budget = {.progress = std::ref(solutions)}});
    EXPECT_EQ(solutions.last, 1);
    EXPECT_LE(solutions.calls, 100);
  }
}

TEST(BatchBudget, EachPoseHasWorkOfItsOwn) {
  testing::Random random;
  const Arm arm = built_in("iiwa14");
  constexpr Eigen::Index count = 200;
  Eigen::MatrixXd goals(16, count);
  for (auto goal : goals.colwise()) {
    goal = forward_kinematics(arm, random.configuration(arm)).matrix().reshaped();
  }
  const InverseOptions few{.method = InverseMethod::numerical, .budget = {.max_work = 20}};
  Eigen::MatrixXd first(7, count), other(7, count);
  const BatchResult one =
      batch_inverse(arm, goals, middle_configuration(arm), first, few, {.threads = 1});
  EXPECT_EQ(one.ending, Ending::complete);
  EXPECT_EQ(one.computed, count);
  const BatchResult four =
      batch_inverse(arm, goals, middle_configuration(arm), other, few, {.threads = 4});
  EXPECT_EQ(four.solved, one.solved);
  EXPECT_TRUE(
      (first.array() == other.array() || (first.array().isNaN() && other.array().isNaN())).all());
}

}  // namespace
}  // namespace beeline
