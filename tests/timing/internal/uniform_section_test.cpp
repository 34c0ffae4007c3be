#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/uniform_section.h>

#include <tests/reason.h>
#include <tests/refusal.h>
#include <tests/timing/random_section.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::RandomSection;

TEST(UniformScaling, HasTheGivenSpeedsScaledToTheLength) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double periods = random.integer(2, 40), period = random.uniform(0.001, 0.1);
    const double length = random.uniform(0.1, 3), end = periods * period;
    const auto speed = [&](double t) { return t * (end - t) * (2 + std::sin(3 * t)); };
    const TimeScaling scaling = uniform_scaling(periods, period, length, speed);
    ASSERT_EQ(scaling.s.size(), std::size_t(periods) + 1);
    ASSERT_EQ(scaling.s.front(), 0);
    ASSERT_EQ(scaling.s.back(), length);
    ASSERT_EQ(scaling.speed.front(), 0);
    ASSERT_EQ(scaling.speed.back(), 0);
    const double scale = scaling.speed[1] / speed(period);
    for (std::size_t k = 1; k < scaling.s.size(); ++k) {
      ASSERT_NEAR(scaling.t[k], double(k) * period, 1e-15 * double(k));
      ASSERT_NEAR(scaling.speed[k], scale * speed(scaling.t[k]), 1e-9);
      ASSERT_NEAR(scaling.s[k] - scaling.s[k - 1],
                  period * (scaling.speed[k] + scaling.speed[k - 1]) / 2, 1e-12);
    }
  }
}

TEST(UniformSection, ShortestIsThatOfTheTimeScalingRoundedUpAndAPeriod) {
  Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    const auto interpolation = testing::interpolations[i % 3];
    const double rate = random.uniform(20, 1000);
    const RandomSection made =
        testing::random_section(random, testing::profile_of_case(i), interpolation, rate, 1);
    const double duration = made.timed.scaling.duration();
    const Trajectory shortest =
        shortest_uniform_section(made.arm, made.timed, made.options).trajectory;
    const double average = interpolation == Interpolation::linear ? 0 : 1;
    ASSERT_EQ(shortest.size() - 1, std::size_t(std::ceil(duration * rate - 1e-6) + average));
    const Trajectory kept = uniform_section(made.arm, made.timed, made.options).trajectory;
    ASSERT_GE(kept.size(), shortest.size());
  }
}

TEST(UniformSection, KeepsTheRateUpToRatesOfAPeriodOrTwo) {
  Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    RandomSection made = testing::random_section(random, testing::profile_of_case(i),
                                                 testing::interpolations[i % 3], 100, 1);
    made.options.timing.rate = random.uniform(1.01, 4) / made.timed.scaling.duration();
    const SampledSection sampled = uniform_section(made.arm, made.timed, made.options);
    if (!sampled) {
      std::cout << sampled.reason << '\n';
      continue;
    }
    const Trajectory& motion = sampled.trajectory;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      ASSERT_EQ(motion.times[k], std::round(double(k) / made.options.timing.rate * 1e9) / 1e9);
    }
    for (int order = 1; order <= 3; ++order) {
      ASSERT_LE(testing::asked_fraction(made.arm, motion, made.options, order), 1 + 1e-9);
    }
  }
}

TEST(UniformSection, LengthensASectionShorterThanAPeriod) {
  Random random;
  RandomSection made =
      testing::random_section(random, Profile::jerk, Interpolation::quintic, 100, 1);
  made.options.timing.rate = 0.1 / made.timed.scaling.duration();
  const Trajectory motion = uniform_section(made.arm, made.timed, made.options).trajectory;
  ASSERT_EQ(motion.size(), 2);
  EXPECT_NEAR(motion.times[1] * made.options.timing.rate, 1, 1e-6);
}

TEST(UniformSection, ReportsTheMotionsSamplesAndDurationUpToHere) {
  Random random;
  for (int i = 0; i < testing::cases(30); ++i) {
    RandomSection made =
        testing::random_section(random, Profile::jerk, Interpolation::quintic, 100, 1);
    SectionOptions& options = made.options;
    const double shortest = made.timed.scaling.duration();
    options.timing.rate = 100 / shortest;
    options.timing.max_samples = random.integer(2, 100);
    options.samples_before = static_cast<std::size_t>(random.integer(1, 500));
    options.begin = random.uniform(0, 100);
    const Reason reason = uniform_section(made.arm, made.timed, options).reason;
    EXPECT_EQ(testing::field<std::size_t>(reason, ReasonField::max_samples),
              static_cast<std::size_t>(options.timing.max_samples));
    EXPECT_GE(testing::field<double>(reason, ReasonField::duration).value_or(0),
              options.begin + shortest);
  }
}

}  // namespace
}  // namespace beeline::internal
