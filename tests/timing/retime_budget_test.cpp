#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/timing/retime.h>

#include "../ended_budget.h"
#include "../random.h"

namespace beeline {
namespace {

/// Positions along random directions, with stops between.
Trajectory recording(const Arm& arm, testing::Random& random, int sections) {
  Trajectory trajectory{arm.joint_names(), {}, {}, {}, {}};
  Configuration q = 0.5 * middle_configuration(arm);
  const auto add = [&] {
    trajectory.times.push_back(static_cast<double>(trajectory.times.size()));
    trajectory.positions.push_back(q);
  };
  add();
  for (int s = 0; s < sections; ++s) {
    for (int k = 0; k < 6; ++k) {
      for (double& value : q) value += random.uniform(-0.1, 0.1);
      add();
    }
    add();  // a repeated position is a stop
  }
  return trajectory;
}

TEST(RetimeBudget, WhatWasFoundKeepsTheLimits) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (const Profile profile : {Profile::jerk, Profile::fastest, Profile::quintic}) {
    for (const double rate : {0.0, 100.0}) {
      SCOPED_TRACE(name(profile) + " at " + number(rate));
      const Trajectory path = recording(arm, random, 2);
      const RetimeOptions options{.profile = profile, .rate = rate};
      const Retimed whole = retime(arm, path, options);
      ASSERT_TRUE(whole) << whole.reason;
      std::size_t sections = 0;
      int ended = 0;
      testing::for_each_cancellation(testing::cases(8), [&](int n) {
        SCOPED_TRACE("cancelled at question " + std::to_string(n));
        testing::CancelAt cancel(n);
        RetimeOptions limited = options;
        limited.budget = cancel.budget();
        const Retimed part = retime(arm, path, limited);
        EXPECT_EQ(part.ending == Ending::cancelled, cancel.cancelled());
        EXPECT_EQ(static_cast<bool>(part), !cancel.cancelled());
        EXPECT_EQ(!part.reason, !cancel.cancelled());
        EXPECT_GE(part.sections, sections);
        sections = part.sections;
        if (sections > 0) {
          const LimitUsage usage = limit_usage(arm, part.trajectory);
          for (const LimitFraction* use : {&usage.velocity, &usage.acceleration, &usage.jerk}) {
            const bool held = use != &usage.jerk || keeps_jerk(profile);
            EXPECT_TRUE(!held || use->fraction <= 1 + 1e-6) << use->fraction;
          }
          EXPECT_EQ(part.trajectory.positions.front(), path.positions.front());
          EXPECT_LE((part.trajectory.positions.back() - path.positions[7 * sections]).norm(), 1e-9);
          EXPECT_EQ(part.trajectory.velocities.back().norm(), 0);
        }
        ++ended;
        return cancel.cancelled() && !::testing::Test::HasFailure();
      });
      EXPECT_EQ(sections, whole.sections);
      EXPECT_GT(ended, 3);
    }
  }
}

TEST(RetimeBudget, SamplesAreThoseOfTheWholeMotionOrNone) {
  const Arm arm = built_in("panda");
  const Configuration from = middle_configuration(arm);
  const PointToPoint motion = point_to_point(arm, from, from.array() + 0.5);
  const Trajectory whole = sampled(arm, motion, 1000);
  int ended = 0;
  testing::for_each_cancellation(100, [&](int n) {
    testing::CancelAt cancel(n);
    const Trajectory part = sampled(arm, motion, 1000, cancel.budget());
    EXPECT_EQ(part.positions, cancel.cancelled() ? std::vector<Configuration>() : whole.positions);
    ended += cancel.cancelled() ? 1 : 0;
    return cancel.cancelled() && !::testing::Test::HasFailure();
  });
  EXPECT_GT(ended, 10);
}

TEST(RetimeBudget, LongTrajectoriesNeedMaxSamples) {
  const Arm arm = built_in("rrr");
  Trajectory trajectory{arm.joint_names(), {}, {}, {}, {}};
  const int count = default_max_samples + 1;
  for (int k = 0; k < count; ++k) {
    trajectory.times.push_back(k);
    trajectory.positions.push_back(Configuration::Constant(3, 1e-6 * k));
  }
  const Retimed refused = retime(arm, trajectory);
  EXPECT_EQ(refused.reason.code, ReasonCode::too_many_samples_given);
  EXPECT_EQ(refused.trajectory.size(), 0u);
  const Retimed begun = retime(arm, trajectory, {.max_samples = count, .budget = {.max_work = 1}});
  EXPECT_EQ(begun.ending, Ending::work_limit);
}

}  // namespace
}  // namespace beeline
