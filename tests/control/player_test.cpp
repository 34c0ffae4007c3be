#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/player.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/retime.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double period = 1e-3;

/// A recording within the panda's limits, through a few random configurations.
Trajectory recording(testing::Random& random, const Arm& arm) {
  Trajectory path{arm.joint_names(), {}, {}, {}, {}};
  const Configuration middle = middle_configuration(arm);
  for (int i = 0; i < 5; ++i) {
    path.times.push_back(i);
    path.positions.push_back(middle + 0.3 * (random.configuration(arm) - middle));
  }
  return retime(arm, path).trajectory;
}

struct Played {
  std::vector<Configuration> q, v;
  double largest_velocity = 0, largest_acceleration = 0;  ///< relative to the limits
};

/// Plays to the end with the target speeds speed_at(step).
template <class Speed>
Played play(Player& player, const Arm& arm, Speed&& speed_at, int max_steps = 100'000) {
  Played played;
  for (int i = 0; i < max_steps && !player.done(); ++i) {
    player.set_speed(speed_at(i));
    const Command& command = player.step();
    played.q.push_back(command.q);
    played.v.push_back(command.velocity);
  }
  for (std::size_t k = 2; k < played.q.size(); ++k) {
    const Configuration v = (played.q[k] - played.q[k - 1]) / period;
    const Configuration before = (played.q[k - 1] - played.q[k - 2]) / period;
    for (int i = 0; i < arm.dof(); ++i) {
      const Limits& limits = arm.limits(i);
      played.largest_velocity = std::max(played.largest_velocity, std::abs(v[i]) / limits.velocity);
      played.largest_acceleration = std::max(
          played.largest_acceleration, std::abs(v[i] - before[i]) / period / limits.acceleration);
    }
  }
  return played;
}

TEST(Player, LeadsInAndPlaysToTheEnd) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 5; ++i) {
    const Trajectory path = recording(random, arm);
    const Configuration start = 0.5 * (random.configuration(arm) + middle_configuration(arm));
    Player player(arm, path, start, {.time_step = period});
    EXPECT_TRUE(player.leading_in());
    const Played played = play(player, arm, [](int) { return 1.0; });
    EXPECT_TRUE(player.done());
    EXPECT_LT((played.q.front() - start).norm(), 0.01);
    EXPECT_EQ(played.q.back(), path.positions.back());
    EXPECT_TRUE(played.v.back().isZero(0));
    EXPECT_LT(played.largest_velocity, 1.001);
    EXPECT_LT(played.largest_acceleration, 1.2);
  }
}

TEST(Player, PausesAndContinuesOnThePath) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory path = recording(random, arm);
  Player steady(arm, path, path.positions.front(), {.time_step = period});
  const Played whole = play(steady, arm, [](int) { return 1.0; });
  Player paused(arm, path, path.positions.front(), {.time_step = period, .ramp = 0.2});
  const Played stops = play(paused, arm, [](int step) { return step / 700 % 2 == 0 ? 0.6 : 0.0; });
  EXPECT_TRUE(paused.done());
  EXPECT_GT(stops.q.size(), 1.5 * static_cast<double>(whole.q.size()));
  EXPECT_LT(stops.largest_velocity, 1.001);
  bool paused_once = false;
  for (const Configuration& v : stops.v) paused_once |= v.isZero(0);
  EXPECT_TRUE(paused_once);
  // Every position is on the path that was played at full speed.
  for (std::size_t k = 0; k < stops.q.size(); k += 97) {
    double nearest = 1;
    for (const Configuration& q : whole.q) nearest = std::min(nearest, (q - stops.q[k]).norm());
    ASSERT_LT(nearest, 5e-3) << "step " << k;
  }
}

TEST(Player, ChangesItsSpeedLinearly) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory path = recording(random, arm);
  Player player(arm, path, path.positions.front(), {.time_step = period, .ramp = 0.5});
  double before = player.speed();
  for (int i = 0; i < 3000 && !player.done(); ++i) {
    player.set_speed(random.uniform(0, 1));
    player.step();
    ASSERT_LE(std::abs(player.speed() - before), period / 0.5 + 1e-12);
    before = player.speed();
  }
}

TEST(Player, ReportsTheTrackingError) {
  const Arm arm = built_in("panda");
  testing::Random random;
  const Trajectory path = recording(random, arm);
  Player player(arm, path, path.positions.front(), {.time_step = period});
  for (int i = 0; i < 100; ++i) {
    Configuration q = player.step().q;
    q[2] += i % 2 == 0 ? 0.01 : -0.03;
    player.measured(q);
  }
  const TrackingError error = player.tracking();
  EXPECT_EQ(error.steps, 100);
  EXPECT_NEAR(error.largest[2], 0.03, 1e-12);
  EXPECT_NEAR(error.rms[2], std::sqrt((1e-4 + 9e-4) / 2), 1e-12);
  EXPECT_EQ(error.largest[0], 0);
}

TEST(Player, CopiesContinueIndependentlyAndMovesKeepTheState) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory path = recording(random, arm);
  Player player(arm, path, path.positions.front(), {.time_step = period});
  for (int i = 0; i < 100; ++i) player.step();
  Player copy = player;
  const Command next = player.step();
  player.step();  // does not change the copy
  Player assigned(arm, path, path.positions.front());
  assigned = copy;
  Player moved = std::move(copy);
  EXPECT_EQ(moved.step().q, next.q);
  EXPECT_EQ(assigned.step().velocity, next.velocity);
  EXPECT_EQ(moved.recording_time(), assigned.recording_time());
}

TEST(Player, RefusesInvalidArguments) {
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  const Trajectory still = at_rest(arm, middle);
  EXPECT_REFUSED(Player(arm, still, middle, {.time_step = 0}), "time step");
  EXPECT_REFUSED(Player(arm, still, middle, {.speed = -1}), "speed");
  EXPECT_REFUSED(Player(arm, Trajectory{arm.joint_names(), {}, {}, {}, {}}, middle), "no samples");
  Configuration outside = middle;
  outside[3] = 1;
  EXPECT_REFUSED(Player(arm, still, outside), "cannot start");
  EXPECT_REFUSED(Player(arm, at_rest(arm, outside), middle), "");
  Player player(arm, still, middle);
  EXPECT_REFUSED(player.set_speed(NAN), "speed");
  EXPECT_REFUSED(player.measured(Configuration::Zero(3)), "3 values");
  EXPECT_TRUE(player.done());
}

TEST(Player, PausesDuringTheLeadInWithContinuousVelocity) {
  const Arm arm = built_in("panda");
  testing::Random random;
  const Trajectory path = recording(random, arm);
  const Configuration start = 0.5 * (random.configuration(arm) + middle_configuration(arm));
  Player player(arm, path, start, {.time_step = period});
  Configuration before = start;
  for (int i = 0; i < 600 && player.leading_in(); ++i) {
    player.set_speed(i / 100 % 2 == 0 ? 1 : 0);
    const Command& command = player.step();
    const Configuration v = (command.q - before) / period;
    ASSERT_LT((v - command.velocity).lpNorm<Eigen::Infinity>(), 0.02) << "step " << i;
    before = command.q;
  }
}

TEST(Player, RefusesARecordingThatLeavesTheLimitsBetweenSamples) {
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  Trajectory path{arm.joint_names(), {0, 1}, {middle, middle}, {}, {}};
  Configuration fast = Configuration::Zero(7);
  fast[0] = 40;
  path.velocities = {fast, -fast};
  path.accelerations = {Configuration::Zero(7), Configuration::Zero(7)};
  EXPECT_REFUSED(Player(arm, path, middle), "");
  // Also after a segment that is too fast.
  path.times = {0, 1, 2};
  path.positions = {middle, middle, middle};
  path.velocities = {Configuration::Zero(7), -fast, fast};
  path.positions[1][6] += 1;
  path.times[1] = 0.1;
  path.accelerations.push_back(Configuration::Zero(7));
  EXPECT_REFUSED(Player(arm, path, middle), "");
}

}  // namespace
}  // namespace beeline
