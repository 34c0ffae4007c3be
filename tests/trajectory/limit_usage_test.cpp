#include <cmath>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// One slide with limits 2 m/s, 10 m/s^2, 100 m/s^3.
Arm slide(double velocity = 2) {
  Joint joint;
  joint.name = "x";
  joint.screw = translation_screw(Vector3::UnitX());
  joint.limits = {.velocity = velocity, .acceleration = 10, .jerk = 100};
  return {"slide", {joint}};
}

Configuration one(double value) { return Configuration::Constant(1, value); }

TEST(LimitUsage, IsThatOfTheMotionThatTheColumnsMean) {
  Trajectory trajectory{{"x"}, {0, 1, 3}, {one(0), one(1), one(-2)}, {}, {}};
  LimitUsage check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 0.75, 1e-12);  // 3 m in 2 s
  EXPECT_EQ(check.velocity.joint, "x");
  EXPECT_EQ(check.velocity.time, 1);
  EXPECT_TRUE(check.velocity.exact);
  EXPECT_NEAR(check.acceleration.fraction, 2.5 / 1.5 / 10, 1e-12);  // by divided differences
  EXPECT_FALSE(check.acceleration.exact);

  trajectory.velocities = {one(0), one(0), one(0)};
  check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 1.5 * 1.5 / 2, 1e-12);     // 3/2 of the mean
  EXPECT_NEAR(check.acceleration.fraction, 6 * 1 / 10.0, 1e-12);  // 6 h / T^2
  EXPECT_EQ(check.acceleration.time, 0);
  EXPECT_TRUE(check.acceleration.exact);
  EXPECT_FALSE(check.jerk.exact);

  trajectory.accelerations = {one(0), one(0), one(0)};
  check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 1.875 * 1.5 / 2, 1e-12);             // 15/8 of the mean
  EXPECT_NEAR(check.acceleration.fraction, 10 / std::sqrt(3) / 10, 1e-12);  // 10 h / (sqrt(3) T^2)
  EXPECT_NEAR(check.jerk.fraction, 60 / 100.0, 1e-12);                      // 60 h / T^3
  EXPECT_TRUE(check.jerk.exact);
}

TEST(LimitUsage, AssumesLimitsThatAreNotKnown) {
  const Trajectory trajectory{{"x"}, {0, 1}, {one(0), one(0.5)}, {one(0), one(0)}, {}};
  const LimitUsage check = limit_usage(slide(Limits::none), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 0.75, 1e-12);
  EXPECT_TRUE(check.velocity.assumed);
  EXPECT_FALSE(check.acceleration.assumed);
  const Arm rrr = built_in("rrr");
  const LimitUsage still = limit_usage(rrr, at_rest(rrr, middle_configuration(rrr)));
  EXPECT_EQ(still.velocity.fraction, 0);
  EXPECT_EQ(still.acceleration.joint, "");
}

// The largest values at many times, by another way to the polynomials: sample().
TEST(LimitUsage, IsWhatDenseSamplingShows) {
  testing::Random random;
  const Arm arm = slide();
  for (int i = 0; i < 200; ++i) {
    Trajectory trajectory{{"x"}, {}, {}, {}, {}};
    const int columns = random.integer(0, 2);
    double t = random.uniform(-3, 3);
    for (int k = 0; k < 5; ++k, t += random.uniform(0.1, 1)) {
      trajectory.times.push_back(t);
      trajectory.positions.push_back(one(random.uniform(-1, 1)));
      if (columns > 0) trajectory.velocities.push_back(one(random.uniform(-1, 1)));
      if (columns > 1) trajectory.accelerations.push_back(one(random.uniform(-1, 1)));
    }
    double velocity = 0, acceleration = 0, jerk = 0;
    constexpr int looks = 5000;
    for (int k = 0; k <= looks; ++k) {
      const double at =
          std::lerp(trajectory.times.front(), trajectory.times.back(), k / double(looks));
      for (const Side side : {Side::before, Side::after}) {
        const TrajectoryState state = sample(trajectory, at, side);
        velocity = std::max(velocity, std::abs(state.velocity[0]) / 2);
        acceleration = std::max(acceleration, std::abs(state.acceleration[0]) / 10);
        jerk = std::max(jerk, std::abs(state.jerk[0]) / 100);
      }
    }
    const LimitUsage check = limit_usage(arm, trajectory);
    EXPECT_GE(check.velocity.fraction, velocity * (1 - 1e-12));
    EXPECT_LE(check.velocity.fraction, velocity * (1 + 1e-3));
    if (columns > 0) {
      EXPECT_GE(check.acceleration.fraction, acceleration * (1 - 1e-12));
    }
    if (columns > 0) {
      EXPECT_LE(check.acceleration.fraction, acceleration * (1 + 1e-2));
    }
    if (columns > 1) {
      EXPECT_GE(check.jerk.fraction, jerk * (1 - 1e-12));
    }
    if (columns > 1) {
      EXPECT_LE(check.jerk.fraction, jerk * (1 + 3e-2));
    }
  }
}

TEST(LimitUsage, OfPositionsIsTheDistanceFromTheMiddleOfTheRange) {
  Joint joint = slide().joints().front();
  joint.limits.lower = 1;
  joint.limits.upper = 3;
  const Arm arm("slide", {joint});
  testing::Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    Trajectory trajectory{{"x"}, {}, {}, {}, {}};
    const bool cubic = random.integer(0, 1) == 1;
    for (int k = 0; k < 4; ++k) {
      trajectory.times.push_back(k);
      trajectory.positions.push_back(one(random.uniform(0.5, 3.5)));
      if (cubic) trajectory.velocities.push_back(one(random.uniform(-3, 3)));
    }
    double largest = 0;
    constexpr int looks = 3000;
    for (int k = 0; k <= looks; ++k) {
      const double q = sample(trajectory, 3.0 * k / looks).position[0];
      largest = std::max(largest, std::abs(q - 2));
    }
    const LimitUsage usage = limit_usage(arm, trajectory);
    EXPECT_GE(usage.position.fraction, largest * (1 - 1e-12));
    EXPECT_LE(usage.position.fraction, largest + 1e-4);
    EXPECT_EQ(usage.position.joint, "x");
    EXPECT_EQ(limit_usage(slide(), trajectory).position.joint, "") << "without a range";
  }
}

TEST(Trajectory, HasADuration) {
  EXPECT_EQ(Trajectory{}.duration(), 0);
  const Trajectory trajectory{{"x"}, {-0.5, 1, 3}, {one(0), one(1), one(-2)}, {}, {}};
  EXPECT_EQ(trajectory.duration(), 3.5);
}

TEST(LimitUsage, RefusesATrajectoryOfAnotherArm) {
  const Trajectory trajectory{{"y"}, {0, 1}, {one(0), one(0.5)}, {}, {}};
  EXPECT_REFUSED(limit_usage(slide(), trajectory), "lacks x");
}

}  // namespace
}  // namespace beeline
