#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

#include <beeline/control/replay.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// A slow random motion within the limits, sampled every `dt` seconds.
Trajectory recording(testing::Random& random, const Arm& arm, int samples, double dt = 0.01,
                     double begin = 0) {
  Trajectory made{arm.joint_names(), {}, {}, {}, {}};
  Configuration q = middle_configuration(arm);
  Configuration velocity = Configuration::Zero(arm.dof());
  for (int k = 0; k < samples; ++k) {
    made.times.push_back(begin + k * dt);
    made.positions.push_back(q);
    for (double& v : velocity) v = random.uniform(-0.5, 0.5);
    q += dt * velocity;
  }
  return made;
}

/// A motion from rest to rest with velocities and accelerations, far below the limits.
Trajectory smooth_recording(testing::Random& random, const Arm& arm, int samples,
                            double dt = 0.01) {
  Trajectory made{arm.joint_names(), {}, {}, {}, {}};
  const double w = 2 * std::numbers::pi / ((samples - 1) * dt);
  Configuration amplitude(arm.dof());
  for (double& a : amplitude) a = random.uniform(-0.5, 0.5) / (w * w);
  for (int k = 0; k < samples; ++k) {
    const double t = k * dt, rate = k + 1 == samples ? 0 : w * std::sin(w * t);
    made.times.push_back(t);
    made.positions.emplace_back(middle_configuration(arm) + (1 - std::cos(w * t)) * amplitude);
    made.velocities.emplace_back(rate * amplitude);
    made.accelerations.emplace_back(w * w * std::cos(w * t) * amplitude);
  }
  return made;
}

TEST(Replay, IsTheRecordingAtItsOwnRateAndSpeed) {
  testing::Random random;
  for (const std::string name : {"panda", "rrr", "scara"}) {
    const Arm arm = built_in(name);
    for (const double begin : {0.0, 17.5, -3.0}) {
      const Trajectory recorded = recording(random, arm, 101, 0.01, begin);
      const Replay played = replay(arm, recorded, {.rate = 100});
      ASSERT_EQ(played.status, MotionStatus::reached) << played.reason;
      ASSERT_EQ(played.trajectory.size(), 101);
      ASSERT_NO_THROW(check_trajectory(played.trajectory));
      EXPECT_EQ(played.lead_in, 0);
      for (std::size_t k = 0; k < 101; ++k) {
        ASSERT_NEAR(played.trajectory.times[k], static_cast<double>(k) * 0.01, 1e-12);
        ASSERT_LT((played.trajectory.positions[k] - recorded.positions[k]).norm(), 1e-11);
      }
    }
  }
}

TEST(Replay, TakesTwiceTheTimeAtHalfTheSpeed) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory recorded = smooth_recording(random, arm, 50);
  for (const double speed : {0.5, 0.25, 2.0}) {
    const Replay played = replay(arm, recorded, {.rate = 133, .speed = speed});
    ASSERT_EQ(played.status, MotionStatus::reached) << played.reason;
    const double periods = std::ceil(0.49 / speed * 133), actual = 0.49 / (periods / 133);
    EXPECT_NEAR(played.trajectory.times.back(), periods / 133, 1e-9);
    for (std::size_t k = 0; k < played.trajectory.size(); ++k) {
      const Configuration expected = sample(recorded, played.trajectory.times[k] * actual).position;
      ASSERT_LT((played.trajectory.positions[k] - expected).norm(), 1e-9);
    }
    EXPECT_EQ(played.trajectory.positions.back(), recorded.positions.back());
  }
}

TEST(Replay, SamplesAtTheRateFromTheFirstToTheLast) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Trajectory recorded = smooth_recording(random, arm, 20, 0.0137);
  for (const double rate : {0.1, 3.0, 100.0, 999.0}) {
    const Trajectory played = replay(arm, recorded, {.rate = rate}).trajectory;
    ASSERT_EQ(played.size(), std::ceil(19 * 0.0137 * rate) + 1);
    for (std::size_t k = 0; k < played.size(); ++k) {
      ASSERT_NEAR(played.times[k], static_cast<double>(k) / rate, 1e-9);
    }
    ASSERT_EQ(played.positions.front(), recorded.positions.front());
    ASSERT_EQ(played.positions.back(), recorded.positions.back());
  }
}

// Without a rate the replay is the same motion at another speed, whatever the columns.
TEST(Replay, PlaysTheMotionThatTheColumnsMean) {
  testing::Random random;
  const Arm arm = built_in("panda");
  Trajectory whole = recording(random, arm, 20, 0.5);
  const std::size_t last = whole.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const bool end = k == 0 || k == last;
    whole.velocities.push_back(Configuration::Constant(7, end ? 0 : random.uniform(-0.01, 0.01)));
    whole.accelerations.push_back(Configuration::Constant(7, end ? 0 : random.uniform(-0.1, 0.1)));
  }
  for (int columns = 0; columns < 3; ++columns) {
    Trajectory recorded = whole;
    if (columns < 2) recorded.accelerations.clear();
    if (columns < 1) recorded.velocities.clear();
    const Replay played = replay(arm, recorded, {.speed = 0.5});
    ASSERT_EQ(played.status, MotionStatus::reached) << played.reason;
    ASSERT_EQ(played.trajectory.interpolation(), recorded.interpolation());
    for (int i = 0; i < 100; ++i) {
      const double t = random.uniform(0, recorded.times.back());
      const TrajectoryState is = sample(played.trajectory, 2 * t), was = sample(recorded, t);
      ASSERT_LT((is.position - was.position).norm(), 1e-12);
      ASSERT_LT((is.velocity - 0.5 * was.velocity).norm(), 1e-10);
      ASSERT_LT((is.acceleration - 0.25 * was.acceleration).norm(), 1e-8);
    }
  }
}

TEST(Replay, MovesToTheFirstSampleWithinLimits) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 20; ++i) {
    const Trajectory recorded = recording(random, arm, 50);
    const Configuration start = random.configuration(arm);
    const Replay played = replay(arm, recorded, {.start = start});
    ASSERT_EQ(played.status, MotionStatus::reached) << played.reason;
    const Trajectory& way = played.trajectory;
    ASSERT_NO_THROW(check_trajectory(way));
    ASSERT_GT(played.lead_in, 0);
    ASSERT_EQ(way.positions.front(), start);
    ASSERT_LT((sample(way, played.lead_in).position - recorded.positions.front()).norm(), 1e-9);
    ASSERT_NEAR(way.times.back(), played.lead_in + 0.49, 1e-12);
    ASSERT_EQ(way.positions.back(), recorded.positions.back());
    for (std::size_t k = 1; k < way.size(); ++k) {
      ASSERT_TRUE(limit_violations(arm, way.positions[k]).empty());
      for (int j = 0; j < 7; ++j) {
        const double speed = std::abs(way.positions[k][j] - way.positions[k - 1][j]) /
                             (way.times[k] - way.times[k - 1]);
        ASSERT_LE(speed, arm.limits(j).velocity * (1 + 1e-6));
      }
    }
  }
  const Trajectory recorded = recording(random, arm, 50);
  EXPECT_EQ(replay(arm, recorded, {.start = recorded.positions.front()}).lead_in, 0);
}

TEST(Replay, NamesTheJointAndTheTimeThatLeaveTheLimits) {
  testing::Random random;
  const Arm arm = built_in("panda");
  Trajectory recorded = recording(random, arm, 30, 0.5, 2);
  recorded.positions[7][3] = 0.1;
  const Replay played = replay(arm, recorded);
  EXPECT_EQ(played.status, MotionStatus::outside_limits);
  EXPECT_EQ(testing::field<double>(played.reason, ReasonField::time), 5.5);
  EXPECT_EQ(testing::joint(played.reason), "joint4");
  EXPECT_EQ(played.trajectory.size(), 0);

  const Replay off = replay(arm, recording(random, arm, 3), {.start = Configuration::Zero(7)});
  EXPECT_EQ(off.status, MotionStatus::outside_limits);
  EXPECT_EQ(testing::joint(off.reason), "joint4") << off.reason;
}

TEST(Replay, NamesTheJointThatIsTooFastAndTheSpeedThatSuffices) {
  testing::Random random;
  const Arm arm = built_in("panda");
  Trajectory recorded = recording(random, arm, 30, 1);
  recorded.positions[7] = recorded.positions[8] = recorded.positions[6];
  recorded.times[8] = recorded.times[7] + 0.1;
  recorded.positions[8][4] += 0.522;  // 5.22 rad/s: twice the limit of 2.61
  for (std::size_t k = 9; k < 30; ++k) recorded.positions[k] = recorded.positions[8];
  const Replay played = replay(arm, recorded);
  EXPECT_EQ(played.status, MotionStatus::outside_limits);
  EXPECT_NEAR(played.limits.velocity.fraction, 2, 1e-9);
  EXPECT_EQ(testing::field<double>(played.reason, ReasonField::time), 7.0);
  EXPECT_EQ(testing::joint(played.reason), "joint5");
  EXPECT_EQ(testing::field<double>(played.reason, ReasonField::kept_speed), 0.5) << played.reason;
  const Replay slower = replay(arm, recorded, {.speed = 0.499});
  EXPECT_EQ(slower.status, MotionStatus::reached) << slower.reason;
  EXPECT_NEAR(slower.limits.velocity.fraction, 0.998, 1e-6);
}

TEST(Replay, MatchesJointsByName) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Trajectory recorded = recording(random, arm, 20);
  Trajectory turned = recorded;
  std::reverse(turned.joint_names.begin(), turned.joint_names.end());
  for (Configuration& q : turned.positions) q = Configuration(q.reverse());
  EXPECT_EQ(replay(arm, turned).trajectory.positions, replay(arm, recorded).trajectory.positions);
  turned.joint_names[0] = "elbow";
  EXPECT_REFUSED(replay(arm, turned), "elbow");
}

TEST(Replay, TakesARecordingOfOneSample) {
  const Arm arm = built_in("rrr");
  const Configuration q{{1, 2, 3}};
  EXPECT_EQ(replay(arm, at_rest(arm, q)).trajectory.size(), 1);
  const Replay moved = replay(arm, at_rest(arm, q), {.start = Configuration::Zero(3)});
  EXPECT_EQ(moved.status, MotionStatus::reached);
  EXPECT_EQ(moved.trajectory.positions.back(), q);
  EXPECT_EQ(moved.trajectory.times.back(), moved.lead_in);
}

TEST(Replay, TakesAnyNumberOfRecordedSamples) {
  const Arm arm = built_in("rp");
  Trajectory recorded{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k < 1'000'000; ++k) {
    recorded.times.push_back(1e-3 * k);
    recorded.positions.emplace_back(Configuration{{1e-6 * k, 0.1}});
  }
  const Replay played = replay(arm, recorded);
  ASSERT_TRUE(played) << played.reason;
  EXPECT_EQ(played.trajectory.size(), recorded.size());
}

TEST(Replay, InStepsSeesEverySampleThatAStepPasses) {
  const Arm arm = built_in("rrr");
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) joint.limits.velocity = 1;
  const Arm slow(arm.name(), joints, arm.tool(), arm.base());
  Trajectory recorded{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k <= 100; ++k) {  // 20 rad/s for a millisecond, within a step of ten
    recorded.times.push_back(1e-3 * k);
    recorded.positions.emplace_back(Configuration::Constant(3, k < 54 ? 0 : 0.02));
  }
  const Replay played = replay(slow, recorded, {.rate = 100, .speed_at = {{0, 1}}, .ramp = 1e-3});
  EXPECT_EQ(played.status, MotionStatus::outside_limits);
  EXPECT_NEAR(played.limits.velocity.fraction, 20, 4);  // each section is up to a period slower
  EXPECT_NEAR(testing::field<double>(played.reason, ReasonField::time).value_or(0), 0.053, 1e-9);
}

TEST(Replay, ChangesItsSpeedAndPausesAtTheGivenTimes) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory recorded = smooth_recording(random, arm, 50, 0.1);  // of 4.9 s
  const ReplayOptions options{.rate = 100, .speed_at = {{0, 0.5}, {2, 0}, {5, 1}}, .ramp = 0.1};
  const Replay played = replay(arm, recorded, options);
  ASSERT_EQ(played.status, MotionStatus::reached) << played.reason;
  const Trajectory& way = played.trajectory;
  ASSERT_NO_THROW(check_trajectory(way));
  EXPECT_EQ(way.positions.front(), recorded.positions.front());
  EXPECT_EQ(way.positions.back(), recorded.positions.back());
  EXPECT_TRUE(way.velocities.front().isZero(0));
  EXPECT_TRUE(way.velocities.back().isZero(0));
  EXPECT_EQ(played.lead_in, 0);
  for (const double t : {3.0, 4.0, 5.0}) {  // ramps last longer where accelerations are known
    EXPECT_EQ(sample(way, t).position, way.positions[300]);
  }
  EXPECT_GT(way.times.back(), 5 + 3.9);
  EXPECT_LT(way.times.back(), 5 + 3.9 + 1);
  // Every position is on the recording's path, in order.
  double place = 0;
  for (const Configuration& q : way.positions) {
    while (place < 4.9 && (sample(recorded, place).position - q).norm() > 2e-3) place += 1e-3;
    ASSERT_LT((sample(recorded, place).position - q).norm(), 2e-3);
  }
}

TEST(Replay, ChangesItsSpeedDuringTheLeadInToo) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory recorded = smooth_recording(random, arm, 20, 0.1);
  const Configuration start = random.configuration(arm);
  const double at_once = replay(arm, recorded, {.start = start, .speed_at = {{0, 1}}}).lead_in;
  for (const double rate : {0.0, 500.0}) {
    const double full = replay(arm, recorded, {.rate = rate, .start = start}).lead_in;
    const Replay slow = replay(arm, recorded, {.rate = rate, .speed = 0.1, .start = start});
    EXPECT_NEAR(slow.lead_in, 10 * full, 0.03 * 10 * full);
    EXPECT_LE(slow.limits.velocity.fraction, 0.1 + 1e-6);
  }
  const ReplayOptions options{.start = start, .speed_at = {{0, 1}, {0.1, 0}, {3, 1}}};
  const Replay paused = replay(arm, recorded, options);
  ASSERT_EQ(paused.status, MotionStatus::reached) << paused.reason;
  EXPECT_GT(at_once, 0);
  EXPECT_GT(paused.lead_in, at_once + 2);
  EXPECT_EQ(paused.trajectory.positions.front(), start);
  const Configuration& first = recorded.positions.front();
  EXPECT_LT((sample(paused.trajectory, paused.lead_in).position - first).norm(), 1e-9);
}

TEST(Replay, NamesTheSpeedThatSufficesAmongSeveral) {
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  const Configuration rest = Configuration::Zero(7);
  Trajectory recorded{arm.joint_names(), {0, 4}, {middle, middle}, {rest, rest}, {}};
  recorded.positions[1][0] += 2;  // a cubic, whose largest velocity is 3/2 of its mean one
  recorded.times[1] = 1.5 * 2 / (2 * arm.limits(0).velocity);  // at twice the limit
  const Replay fast = replay(arm, recorded, {.rate = 1000, .speed_at = {{0, 1}}, .ramp = 0.01});
  EXPECT_EQ(fast.status, MotionStatus::outside_limits);
  EXPECT_EQ(fast.trajectory.size(), 0);
  EXPECT_EQ(testing::joint(fast.reason), "joint1") << fast.reason;
  EXPECT_EQ(testing::field<double>(fast.reason, ReasonField::kept_speed), 0.5) << fast.reason;
  const Replay slow = replay(arm, recorded, {.rate = 1000, .speed_at = {{0, 0.499}}});
  EXPECT_EQ(slow.status, MotionStatus::reached) << slow.reason;
  EXPECT_NEAR(slow.limits.velocity.fraction, 0.998, 1e-3);
}

TEST(Replay, RefusesInvalidSpeeds) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Trajectory recorded = recording(random, arm, 20);
  const auto with = [&](std::vector<SpeedChange> changes) {
    return replay(arm, recorded, {.speed_at = std::move(changes)});
  };
  EXPECT_REFUSED(with({{0, 1}, {2, 0}}), "pauses at 2 s");
  EXPECT_REFUSED(with({{2, 1}, {1, 0.5}}), "1 s after 2 s");
  EXPECT_REFUSED(with({{-1, 1}}), "-1 s");
  EXPECT_REFUSED(with({{NAN, 1}}), "increase");
  EXPECT_REFUSED(with({{0, 1.5}}), "from 0 to 1, not 1.5");
  EXPECT_REFUSED(with({{0, 0}, {1e9, 1}}), "samples");
  EXPECT_REFUSED(replay(arm, recorded, {.rate = 1, .speed_at = {{0, 1}}}), "or more are needed");
  EXPECT_REFUSED(replay(arm, recorded, {.speed = 2, .speed_at = {{0, 1}}}), "speed");
  EXPECT_REFUSED(replay(arm, recorded, {.speed_at = {{0, 1}}, .ramp = 0}), "ramp");
}

TEST(Replay, IsPrintedWithItsUseOfTheLimitsOrItsReason) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Trajectory recorded = recording(random, arm, 20);
  const auto printed = [](const Replay& replayed) {
    std::ostringstream text;
    text << replayed;
    return text.str();
  };
  const Replay played = replay(arm, recorded);
  ASSERT_TRUE(played) << played.reason;
  EXPECT_EQ(printed(played), "reached in 0.19 s, 20 samples, up to " +
                                 percent_at_most(played.limits.velocity.fraction) +
                                 " of the velocity limits");
  const Replay fast = replay(arm, recorded, {.speed = 100});
  ASSERT_FALSE(fast);
  EXPECT_EQ(printed(fast), "outside_limits: " + sentence(fast.reason));
}

TEST(Replay, RefusesInvalidArguments) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Trajectory recorded = recording(random, arm, 20);
  EXPECT_REFUSED(replay(arm, recorded, {.rate = -1}), "rate");
  EXPECT_REFUSED(replay(arm, recorded, {.rate = NAN}), "rate");
  EXPECT_REFUSED(replay(arm, recorded, {.speed = -1}), "speed");
  EXPECT_REFUSED(replay(arm, recorded, {.speed = INFINITY}), "speed");
  EXPECT_REFUSED(replay(arm, recorded, {.rate = 1e12}), "samples");
  EXPECT_REFUSED(replay(arm, recorded, {.rate = 100, .speed = 1e-12}), "samples");
  Trajectory endless = recorded;
  endless.times.back() = 1e300;
  EXPECT_REFUSED(replay(arm, endless, {.rate = 100}), "samples");
  EXPECT_REFUSED(replay(arm, {}), "no samples");
  EXPECT_REFUSED(replay(arm, recorded, {.start = Configuration::Zero(2)}), "3 joint values");
  Trajectory still = recorded;
  still.times[4] = still.times[3];
  EXPECT_REFUSED(replay(arm, still), "sample 5");
}

}  // namespace
}  // namespace beeline
