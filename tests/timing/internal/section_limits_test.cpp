#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/section_limits.h>

#include <tests/timing/random_section.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::RandomSection;

constexpr double dense_error = 1e-3;  // of the largest at 200 points between samples

TEST(NeededSlowdown, BringsAMotionExactlyToItsLimits) {
  Random random;
  for (int i = 0; i < testing::cases(100); ++i) {
    const Arm arm = testing::limited_arm(random);
    const Trajectory motion = testing::random_motion(
        random, arm.joint_names(), random.integer(2, 6), testing::interpolations[1 + i % 2]);
    const SectionOptions options{.timing = {.profile = i % 3 > 0 ? Profile::jerk : Profile::fastest,
                                            .speed_scale = random.uniform(0.1, 1)}};
    const NeededSlowdown needed = needed_slowdown(arm, motion, options);
    const auto fraction = [&](int order) {
      return std::pow(testing::asked_fraction(arm, motion, options, order, 200), 1.0 / order);
    };
    const double speed = std::max(fraction(1), fraction(2));
    ASSERT_NEAR(needed.speed, speed, dense_error * speed);
    if (motion.interpolation() == Interpolation::quintic) {
      ASSERT_NEAR(needed.jerk, fraction(3), dense_error * fraction(3));
    }
    ASSERT_EQ(needed.both(), std::max(needed.speed, needed.jerk));
  }
}

/// The excess of the interval after sample k over the limits of an order.
double excess_after(const Arm& arm, const Trajectory& motion, const SectionOptions& options,
                    std::size_t k, int order) {
  const auto cut = [&](const std::vector<Configuration>& column) {
    return std::vector<Configuration>{column[k], column[k + 1]};
  };
  const Trajectory interval{motion.joint_names,
                            {motion.times[k], motion.times[k + 1]},
                            cut(motion.positions),
                            cut(motion.velocities),
                            cut(motion.accelerations)};
  return testing::asked_fraction(arm, interval, options, order, 100);
}

/// The arm with one joint's limits multiplied by a factor.
Arm with_weaker_joint(Random& random, const Arm& arm, double factor) {
  std::vector<Joint> joints = arm.joints();
  Limits& limits = joints[std::size_t(random.integer(0, arm.dof() - 1))].limits;
  const Limits all = motion_limits(limits);
  limits.velocity = factor * all.velocity;
  limits.acceleration = factor * all.acceleration;
  limits.jerk = factor * all.jerk;
  return {"weaker", joints};
}

/// Checks the lowered limits at each grid point: the limits of the worst interval at it or beside
/// it, and none where no interval near it exceeds a limit. Returns the number of such points.
int expect_lowered_only_there(const Arm& arm, const SampledSection& samples,
                              const SectionOptions& options, const TimedSection& before,
                              const TimedSection& lowered) {
  const std::vector<double>& s = before.path.s;
  const std::size_t intervals = samples.progress.size() - 1;
  std::vector<double> speed(intervals), force(intervals);
  for (std::size_t k = 0; k < intervals; ++k) {
    const auto excess = [&](int order) {
      return excess_after(arm, samples.trajectory, options, k, order);
    };
    const bool smooth = before.scaling.smooth;
    speed[k] = smooth ? excess(1) : std::max(excess(1), std::sqrt(excess(2)));
    force[k] = smooth ? std::max(excess(2), excess(3)) : 0;
  }
  int touched = 0;
  for (std::size_t g = 0; g < s.size(); ++g) {
    double inside = 0, near = 0;  // the largest excess of intervals at the point, or a step away
    const double left = s[g > 0 ? g - 1 : g], right = s[std::min(g + 1, s.size() - 1)];
    for (std::size_t k = 0; k < intervals; ++k) {
      const double a = samples.progress[k].s, b = samples.progress[k + 1].s;
      if (a <= s[g] && s[g] <= b) inside = std::max(inside, force[k]);
      if (a <= right && left <= b) near = std::max({near, force[k], speed[k]});
    }
    const double fraction = lowered.limits.fraction[g];
    EXPECT_LE(fraction, 1);
    EXPECT_LE(lowered.limits.speed[g],
              before.limits.speed.empty() ? Limits::none : before.limits.speed[g]);
    const bool untouched = fraction == 1 && lowered.limits.speed[g] == Limits::none;
    if (near < 1) {
      EXPECT_TRUE(untouched) << "grid point " << g;
    }
    if (inside > 1.002) {
      EXPECT_LE(fraction, 1 / inside * (1 + dense_error)) << "grid point " << g;
    }
    if (!untouched) ++touched;
  }
  return touched;
}

TEST(LowerLimits, OnlyLowersThemAndOnlyWhereSamplesExceedThem) {
  Random random;
  int touched = 0, points = 0, exceeded = 0;
  const int count = testing::cases(30);
  for (int i = 0; i < count; ++i) {
    const Profile profile = i % 2 == 0 ? Profile::jerk : Profile::fastest;
    const RandomSection made =
        testing::random_section(random, profile, Interpolation::quintic, i % 4 < 2 ? 0 : 250, 1);
    const SampledSection samples = sample_section(made.arm, made.timed, made.options);
    const Arm weaker = with_weaker_joint(random, made.arm, random.uniform(0.3, 1));
    TimedSection lowered = made.timed;
    const bool any = lower_limits(weaker, samples, made.options, lowered);
    ASSERT_EQ(lowered.limits.fraction.size(), made.timed.path.size());
    ASSERT_EQ(lowered.limits.speed.size(), made.timed.path.size());
    const int here = expect_lowered_only_there(weaker, samples, made.options, made.timed, lowered);
    ASSERT_EQ(any, here > 0);
    touched += here;
    exceeded += any;
    points += int(made.timed.path.size());
  }
  EXPECT_GT(exceeded, count / 4);
  EXPECT_LT(touched, 0.9 * points) << "some places stay as they are";
}

TEST(LowerLimits, ChangesNothingWhereNothingExceeds) {
  Random random;
  for (int i = 0; i < testing::cases(20); ++i) {
    const Profile profile = i % 2 == 0 ? Profile::jerk : Profile::fastest;
    const RandomSection made =
        testing::random_section(random, profile, testing::interpolations[i % 3], 0, 1);
    const SampledSection samples = sample_section(made.arm, made.timed, made.options);
    TimedSection lowered = made.timed;
    EXPECT_FALSE(lower_limits(made.arm, samples, made.options, lowered));
    for (std::size_t g = 0; g < made.timed.path.size(); ++g) {
      ASSERT_EQ(lowered.limits.speed[g], Limits::none);
      ASSERT_EQ(lowered.limits.fraction[g], 1);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
