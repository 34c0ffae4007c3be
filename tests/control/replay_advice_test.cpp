#include <cmath>
#include <gtest/gtest.h>
#include <optional>

#include <beeline/control/replay.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/retime.h>

#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

/// A motion at the limits through random configurations, played at a part of its speed.
Trajectory slow_recording(testing::Random& random, const Arm& arm, Interpolation interpolation,
                          double rate) {
  Trajectory waypoints{arm.joint_names(), {0, 1, 2}, {}, {}, {}};
  const Configuration middle = middle_configuration(arm);
  for (int k = 0; k < 3; ++k) {
    waypoints.positions.emplace_back(middle + 0.6 * (random.configuration(arm) - middle));
  }
  Trajectory made =
      retime(arm, waypoints, {.interpolation = interpolation, .rate = rate}).trajectory;
  if (made.size() > 0) slow_down(made, random.uniform(1, 20));
  return made;
}

ReplayOptions slower(ReplayOptions options, double speed) {
  options.speed = std::min(options.speed, speed);
  for (SpeedChange& change : options.speed_at) change.speed = std::min(change.speed, speed);
  return options;
}

std::optional<double> advised_speed(const Reason& reason) {
  return testing::field<double>(reason, ReasonField::kept_speed);
}

/// The options with what the reason advises; none without advice.
std::optional<ReplayOptions> advised(ReplayOptions options, const Reason& reason) {
  if (const auto rate = testing::field<double>(reason, ReasonField::kept_rate)) {
    options.rate = *rate;
  } else if (const auto ramp = testing::field<double>(reason, ReasonField::kept_ramp)) {
    options.ramp = *ramp;
  } else if (const auto speed = advised_speed(reason)) {
    return slower(options, *speed);
  } else if (reason.has(ReasonField::kept_without_rate)) {
    options.rate = 0;
  } else {
    return {};
  }
  return options;
}

TEST(Replay, AdviceThatItGivesWorks) {
  testing::Random random;
  int refused = 0, helped = 0;
  for (int round = 0; round < testing::cases(20); ++round) {
    const char* names[] = {"panda", "rrr", "ur5"};
    const Arm arm = built_in(names[random.integer(0, 2)]);
    const double rates[] = {0, 50, 100};
    const Trajectory recorded = slow_recording(
        random, arm, static_cast<Interpolation>(random.integer(0, 2)), rates[random.integer(0, 2)]);
    if (recorded.size() == 0) continue;
    ReplayOptions options{.rate = random.integer(0, 1) == 0 ? 0.0 : 1000,
                          .speed = random.uniform(1, 100)};
    if (random.integer(0, 1) == 0) {
      options.speed = 1;
      options.speed_at = {{0, 1}, {0.2, 0.3}, {0.4, 1}};
      options.ramp = random.uniform(0.02, 1);
    }
    const Replay played = replay(arm, recorded, options);
    if (played) continue;
    ++refused;
    const auto better = advised(options, played.reason);
    if (!better) continue;
    ++helped;
    const Replay again = replay(arm, recorded, *better);
    EXPECT_TRUE(again) << played.reason << "\n" << again.reason;
    const auto speed = advised_speed(played.reason);
    if (!speed || !played.reason.has(ReasonField::kept_at_rate)) continue;
    const Replay slow = replay(arm, recorded, slower(options, *speed));
    EXPECT_TRUE(slow) << played.reason << "\n" << slow.reason;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GE(2 * helped, refused);
}

// The velocity of linear joints at the ends is limited too; its bound does not scale with speed.
TEST(Replay, AdvisesAHighSpeedWhereOneIsPossible) {
  testing::Random random;
  const Arm arm = built_in("panda");
  Trajectory recorded = slow_recording(random, arm, Interpolation::linear, 100);
  ASSERT_GT(recorded.size(), 0);
  const double possible = 1 / limit_usage(arm, recorded).velocity.fraction;
  const Replay played = replay(arm, recorded, {.speed = 100});
  ASSERT_FALSE(played);
  const auto advice = advised_speed(played.reason);
  ASSERT_TRUE(advice) << played.reason;
  EXPECT_GT(*advice, 0.5 * possible);
}

}  // namespace
}  // namespace beeline
