#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/replay.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/retime.h>

#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

/// A recording at the limits, through random configurations, with or without a rate; empty where
/// the spline through them leaves the position limits.
Trajectory fast_recording(testing::Random& random, const Arm& arm, Interpolation interpolation) {
  Trajectory waypoints{arm.joint_names(), {}, {}, {}, {}};
  const int count = 2 + static_cast<int>(random.uniform(0, 3));
  for (int k = 0; k < count; ++k) {
    waypoints.times.push_back(k);
    const Configuration middle = middle_configuration(arm);
    waypoints.positions.emplace_back(middle + 0.7 * (random.configuration(arm) - middle));
  }
  const double rates[] = {0, 0, 125, 250, 1000};
  const Profile profiles[] = {Profile::jerk, Profile::jerk, Profile::fastest, Profile::quintic};
  const Retimed made = retime(arm, waypoints,
                              {.profile = profiles[random.integer(0, 3)],
                               .interpolation = interpolation,
                               .rate = rates[random.integer(0, 4)]});
  return made.trajectory;
}

Trajectory fast_recording_of_panda(testing::Random& random) {
  Trajectory recorded;
  while (recorded.size() == 0) {
    recorded = fast_recording(random, built_in("panda"), Interpolation::quintic);
  }
  return recorded;
}

ReplayOptions random_options(testing::Random& random, const Arm& arm) {
  const double rates[] = {0, 50, 60, 125, 250, 1000}, speeds[] = {1, 1, 1, 0.9, 0.73, 0.5, 0.1};
  ReplayOptions options{.rate = rates[random.integer(0, 5)], .speed = speeds[random.integer(0, 6)]};
  if (random.integer(0, 2) == 0) {
    options.speed = 1;
    options.speed_at = {{0, random.uniform(0.1, 1)}, {0.5, 0}, {0.8, 1}, {1.2, 0.3}};
  }
  if (random.integer(0, 2) == 0) options.start = random.configuration(arm);
  return options;
}

/// Whether all derivatives that the interpolation bounds are within the limits, and the positions.
void expect_within_limits(const Arm& arm, const Trajectory& played) {
  constexpr double slack = 1 + 2e-9;
  for (std::size_t k = 0; k + 1 < played.size(); ++k) {
    const double h = played.times[k + 1] - played.times[k];
    for (int j = 0; j <= 8; ++j) {
      const TrajectoryState now = sample(played, played.times[k] + h * (j + 1e-9) / 8.00000001);
      for (int i = 0; i < arm.dof(); ++i) {
        const Limits limits = motion_limits(arm.limits(i));
        ASSERT_TRUE(within_position_limits(limits, now.position[i])) << now.position[i];
        ASSERT_LE(std::abs(now.velocity[i]), slack * limits.velocity);
        if (played.velocities.empty()) continue;
        ASSERT_LE(std::abs(now.acceleration[i]), slack * limits.acceleration);
        if (played.accelerations.empty() || !(arm.limits(i).jerk < Limits::none)) continue;
        ASSERT_LE(std::abs(now.jerk[i]), slack * limits.jerk);
      }
    }
  }
}

TEST(Replay, HoldsAllLimitsBetweenSamples) {
  testing::Random random;
  int reached = 0, refused = 0;
  for (int round = 0; round < testing::cases(30); ++round) {
    const char* names[] = {"panda", "ur5", "scara", "rrr"};
    const Arm arm = built_in(names[random.integer(0, 3)]);
    const auto interpolation = static_cast<Interpolation>(random.integer(0, 2));
    const Trajectory recorded = fast_recording(random, arm, interpolation);
    if (recorded.size() == 0) continue;
    const ReplayOptions options = random_options(random, arm);
    const Replay played = replay(arm, recorded, options);
    if (!played) {  // corners of linear motions, jumps of the acceleration of cubic ones
      EXPECT_NE(interpolation, Interpolation::quintic) << played.reason;
      EXPECT_NE(testing::joint(played.reason), "") << played.reason;
      ++refused;
      continue;
    }
    ++reached;
    const Trajectory& trajectory = played.trajectory;
    EXPECT_EQ(trajectory.interpolation(), recorded.interpolation());
    EXPECT_LT(played.slowdown, 2.1);
    expect_within_limits(arm, trajectory);
    if (::testing::Test::HasFatalFailure()) return;
    for (std::size_t k = 0; k < trajectory.size() && options.rate > 0; ++k) {
      const double exact = std::round(static_cast<double>(k) / options.rate * 1e9) / 1e9;
      ASSERT_NEAR(trajectory.times[k], exact, 1e-12);
    }
    if (interpolation != Interpolation::quintic) continue;
    const Replay again = replay(
        arm, trajectory, {.rate = options.rate == 0 ? 0 : 333.0, .speed = random.uniform(0.1, 1)});
    EXPECT_TRUE(again) << again.reason;
  }
  EXPECT_GT(reached, refused);
}

TEST(Replay, RefusesASpeedThatExceedsAnAcceleration) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory recorded = fast_recording_of_panda(random);
  const Replay played = replay(arm, recorded, {.speed = 1.9});
  EXPECT_EQ(played.status, MotionStatus::outside_limits);
  EXPECT_TRUE(played.reason.has(ReasonField::kept_speed)) << played.reason;
}

TEST(Replay, KeepsWhatTheRecordingItselfExceeds) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory recorded = fast_recording_of_panda(random);
  Trajectory faster = recorded;
  for (double& t : faster.times) t /= 1.2;
  for (Configuration& v : faster.velocities) v *= 1.2;
  for (Configuration& a : faster.accelerations) a *= 1.44;
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.limits.velocity *= 2;
  const Arm quick(arm.name(), joints, arm.tool(), arm.base());
  const Replay played = replay(quick, faster, {.rate = 250});
  ASSERT_TRUE(played) << played.reason;
  const LimitUsage own = limit_usage(quick, faster);
  EXPECT_LE(played.limits.acceleration.fraction,
            std::max(1.0, own.acceleration.fraction) * (1 + 1e-8));
  EXPECT_LE(played.limits.jerk.fraction, std::max(1.0, own.jerk.fraction) * (1 + 1e-8));
}

}  // namespace
}  // namespace beeline
