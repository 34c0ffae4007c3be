#include <gtest/gtest.h>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

/// The result of all stages, without the quick ones.
InverseResult thorough(const Arm& arm, const Pose& pose, const InverseOptions& options) {
  internal::SolverState state(arm, options);
  internal::BudgetMeter budget(options.budget);
  return internal::solve_thoroughly(state, pose, *options.seed, internal::FailureDetail::status,
                                    budget);
}

/// Whether the quick stages suffice.
bool suffice(const Arm& arm, const Pose& pose, const InverseOptions& options) {
  internal::SolverState state(arm, options);
  internal::BudgetMeter budget(options.budget);
  internal::Request request = internal::make_request(state, pose, *options.seed, budget);
  request.quick = true;
  internal::StageResult found;
  return internal::run_quick_stages(state, request, found);
}

void expect_same_result(const InverseResult& quick, const InverseResult& expected) {
  EXPECT_EQ(quick.status, expected.status);
  EXPECT_EQ(quick.singular, expected.singular);
  EXPECT_EQ(quick.complete, expected.complete);
  EXPECT_EQ(quick.branches_complete, expected.branches_complete);
  EXPECT_EQ(quick.self_motion_dimension, expected.self_motion_dimension);
  ASSERT_EQ(quick.solutions.size(), expected.solutions.size());
  for (std::size_t i = 0; i < quick.solutions.size(); ++i) {
    EXPECT_LT((quick.solutions[i] - expected.solutions[i]).norm(), 1e-8);
  }
}

/// All solutions, with limits that exclude some, from seeds at random.
TEST(QuickStages, GiveWhatAllStagesGive) {
  testing::Random random;
  for (const char* name : {"ur5", "puma560", "stanford", "scara", "px150", "rrr", "gen3_lite"}) {
    const Arm arm = built_in(name);
    int quick = 0;
    for (int i = 0; i < testing::cases(100); ++i) {
      SCOPED_TRACE(name + std::string(", pose ") + std::to_string(i));
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      InverseOptions options{.seed = random.configuration(arm), .all = true};
      options.ignore_limits = i % 3 == 1;
      if (i % 3 == 2) options.weights = random.configuration(arm).cwiseAbs().cwiseMax(0.1);
      expect_same_result(inverse_kinematics(arm, pose, options), thorough(arm, pose, options));
      quick += suffice(arm, pose, options);
    }
    EXPECT_GE(quick, testing::cases(90)) << name;
  }
}

/// One solution from a seed that is it, also at the singular configurations of joints at zero,
/// which the closed form may lose to rounding.
TEST(QuickStages, GiveWhatAllStagesGiveForASeedThatSolves) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    int quick = 0;
    const int count = testing::cases(30);
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE(name + ", pose " + std::to_string(i));
      Configuration q = random.configuration(arm);
      if (i % 3 == 2) q[random.integer(0, arm.dof() - 1)] = 0;
      q = internal::clamped(internal::bounds_of(arm), q);
      const InverseOptions options{.seed = q};
      const Pose pose = forward_kinematics(arm, q);
      const InverseResult result = inverse_kinematics(arm, pose, options);
      expect_same_result(result, thorough(arm, pose, options));
      EXPECT_EQ(result.solutions.front(), q);
      quick += suffice(arm, pose, options);
    }
    if (has_closed_form(arm)) {
      EXPECT_GE(quick, count / 2) << name;
    }
  }
}

/// A locked first or last joint is an input of the closed form; the other stages see an arm of six
/// joints.
TEST(QuickStages, GiveWhatAllStagesGiveWithALockedJoint) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa14", "fr3"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(100); ++i) {
      SCOPED_TRACE(name + std::string(", pose ") + std::to_string(i));
      const Configuration from = random.configuration(arm);
      Configuration seed = i % 4 == 0 ? from : random.configuration(arm);
      seed[6] = from[6];
      const InverseOptions options{.seed = seed, .all = true, .lock = 6};
      const Pose pose = forward_kinematics(arm, from);
      const InverseResult result = inverse_kinematics(arm, pose, options);
      expect_same_result(result, thorough(arm, pose, options));
      ASSERT_FALSE(result.solutions.empty());
      if (i % 4 == 0) {
        EXPECT_EQ(result.solutions.front(), from);
      }
      for (const Configuration& q : result.solutions) EXPECT_EQ(q[6], seed[6]);
    }
  }
}

TEST(QuickStages, KeepALockedValueOfManyTurns) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 20; ++i) {
    Configuration seed = random.configuration(arm);
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    seed[6] = 2000 + i;
    const InverseOptions options{.seed = seed, .ignore_limits = true, .lock = 6};
    const InverseResult result = inverse_kinematics(arm, pose, options);
    for (const Configuration& q : result.solutions) EXPECT_EQ(q[6], seed[6]);
    Eigen::MatrixXd column(7, 1);
    if (inverse_kinematics(arm, pose, seed, column, options) == 1) {
      EXPECT_EQ(column(6, 0), seed[6]);
    }
  }
}

/// A search that finds nothing ends early where it cannot find anything: the status is the one of
/// all searches, or says more.
TEST(QuickStages, SayNoWithFewRestarts) {
  testing::Random random;
  const Arm arm = built_in("yumi");  // seven joints without a closed form
  const Configuration seed = middle_configuration(arm);
  int unsolved = 0, few = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    Pose pose = random.pose();
    pose.translation() =
        arm.reach().centre + arm.reach().radius * random.uniform(0, 1) * random.direction();
    const InverseResult result = inverse_kinematics(arm, pose, {.seed = seed});
    const InverseResult all = thorough(arm, pose, {.seed = seed});
    if (all.status == InverseStatus::not_found) continue;
    EXPECT_EQ(result.status, all.status) << pose.matrix();
    if (result.status != InverseStatus::orientation_unreachable) continue;
    ++unsolved;
    few += result.restarts <= 48;
  }
  EXPECT_GE(unsolved, testing::slow_build ? 0 : 1);  // few cases may have none
  EXPECT_GE(few, unsolved * 2 / 3) << unsolved;
}

/// No solution is lost by that, also of poses near the limits.
TEST(QuickStages, SayNoWrongNoWithFewRestarts) {
  testing::Random random;
  const Arm arm = built_in("yumi");
  for (int i = 0; i < testing::cases(6000); ++i) {
    Configuration q = random.configuration(arm);
    const int k = random.integer(0, 6);
    if (i % 2 == 0) q[k] = arm.limits(k).upper;
    const Pose pose = forward_kinematics(arm, q);
    EXPECT_TRUE(inverse_kinematics(arm, pose)) << q.transpose();
  }
  for (int i = 0; i < testing::cases(600); ++i) {
    std::vector<Joint> joints;
    for (int k = 0; k < 7; ++k) {
      joints.push_back(testing::random_joint(random, JointKind::revolute, "j" + std::to_string(k)));
    }
    const Arm any("any", joints);
    const Pose pose = forward_kinematics(any, random.configuration(any));
    const Configuration seed = middle_configuration(any);
    const InverseResult result = inverse_kinematics(any, pose, {.seed = seed});
    if (!result) {
      EXPECT_FALSE(thorough(any, pose, {.seed = seed})) << i;
    }
  }
}

}  // namespace
}  // namespace beeline
