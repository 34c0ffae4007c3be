#include <gtest/gtest.h>

#include <beeline/io/internal/setpoints.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

/// A trajectory of two joints with steps of whole periods of 100 Hz.
Trajectory random_motion(testing::Random& random, int columns) {
  Trajectory trajectory{{"a", "b"}, {}, {}, {}, {}};
  const auto values = [&random] {
    return Configuration(Eigen::Vector2d(random.uniform(-1, 1), random.uniform(-1, 1)));
  };
  int period = random.integer(-50, 50);
  for (int k = 0; k < 5; ++k, period += random.integer(1, 40)) {
    trajectory.times.push_back(period / 100.0);
    trajectory.positions.push_back(values());
    if (columns > 1) trajectory.velocities.push_back(values());
    if (columns > 2) trajectory.accelerations.push_back(values());
  }
  return trajectory;
}

TEST(Setpoints, SamplesOfTheGridStayAndDerivativesAreDerivatives) {
  testing::Random random;
  for (int i = 0; i < testing::cases(180); ++i) {
    const Trajectory trajectory = random_motion(random, 1 + i % 3);
    const Trajectory coarse = setpoints(trajectory, 100), fine = setpoints(trajectory, 1e4);
    ASSERT_EQ(coarse.velocities.size(), trajectory.velocities.empty() ? 0 : coarse.size());
    ASSERT_EQ(coarse.accelerations.size(), trajectory.accelerations.empty() ? 0 : coarse.size());
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      const double at = (trajectory.times[k] - trajectory.times[0]) * 100;
      const auto j = static_cast<std::size_t>(std::lround(at));
      ASSERT_LT(j, coarse.size());
      EXPECT_LT((coarse.positions[j] - trajectory.positions[k]).norm(), 1e-9);
    }
    for (std::size_t j = 1; j + 1 < fine.velocities.size(); j += 97) {
      const Configuration slope = (fine.positions[j + 1] - fine.positions[j - 1]) * 0.5e4;
      EXPECT_LT((slope - fine.velocities[j]).norm(), 1e-4 * 1e5);  // accelerations below 1e5
    }
    EXPECT_EQ(coarse.times.front(), 0);
    EXPECT_NEAR(coarse.times.back(), trajectory.times.back() - trajectory.times.front(), 1e-12);
  }
}

TEST(Setpoints, TheLastOneIsAtRestWithinAPeriodOfTheEnd) {
  testing::Random random;
  for (int columns = 1; columns <= 3; ++columns) {
    const Trajectory trajectory = random_motion(random, columns);
    const double duration = trajectory.times.back() - trajectory.times.front();
    const double rate = 3.7 / duration;
    const Trajectory points = setpoints(trajectory, rate);
    ASSERT_EQ(points.size(), 5u);
    EXPECT_EQ(points.positions.back(), trajectory.positions.back());
    if (columns > 1) {
      EXPECT_TRUE(points.velocities.back().isZero(0));
    }
    if (columns > 2) {
      EXPECT_TRUE(points.accelerations.back().isZero(0));
    }
  }
}

TEST(Setpoints, OneSampleIsOneSetpoint) {
  const Trajectory still{{"a"}, {2}, {Configuration::Zero(1)}, {}, {}};
  EXPECT_EQ(setpoints(still, 10).size(), 1u);
  EXPECT_EQ(from_time_zero(still).times, (std::vector<double>{0}));
}

TEST(Setpoints, ManyAreRefused) {
  const Trajectory slow{{"a"}, {0, 100}, {2, Configuration::Zero(1)}, {}, {}};
  EXPECT_REFUSED(setpoints(slow, 1e6), "1e+08 setpoints in 100 s; at most 10 million");
}

/// 0.3 - 0.1 is not the double nearest to 0.2.
TEST(Setpoints, DifferencesOfWholeNanosecondsAreWholeNanoseconds) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const int begin = random.integer(-2'000'000'000, 2'000'000'000),
              later = random.integer(1, 1 << 30);
    Trajectory trajectory{
        {"a"}, {begin / 1e9, (static_cast<double>(begin) + later) / 1e9}, {}, {}, {}};
    EXPECT_EQ(from_time_zero(trajectory).times[1], later / 1e9);
  }
}

}  // namespace
}  // namespace beeline::internal
