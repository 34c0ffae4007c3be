#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>

#include <tests/timing/random_section.h>

namespace beeline::internal {
namespace {

using testing::Random;
using testing::random_section;
using testing::RandomSection;

double whole_nanoseconds(double t) { return std::round(t * 1e9) / 1e9; }

void expect_times(const std::vector<double>& times, double rate) {
  ASSERT_EQ(times.front(), 0);
  for (std::size_t k = 0; k < times.size(); ++k) {
    ASSERT_EQ(times[k], whole_nanoseconds(rate > 0 ? double(k) / rate : times[k]));
    if (k > 0) {
      ASSERT_GT(times[k], times[k - 1]);
    }
  }
}

/// At rest at both ends, which equal the ends of the path.
void expect_rest_at_ends(const Trajectory& motion, const JointPath& path) {
  EXPECT_EQ(motion.positions.front(), path.q.front());
  EXPECT_EQ(motion.positions.back(), path.q.back());
  for (const auto* column : {&motion.velocities, &motion.accelerations}) {
    if (column->empty()) continue;
    EXPECT_LE(column->front().norm(), 1e-9);
    EXPECT_LE(column->back().norm(), 1e-9);
  }
}

/// Samples are points of the path, in order.
void expect_on_path(const SampledSection& found, const JointPath& path) {
  ASSERT_EQ(found.progress.size(), found.trajectory.size());
  std::size_t step = 0;
  for (std::size_t k = 0; k < found.progress.size(); ++k) {
    const double s = found.progress[k].s;
    while (step + 2 < path.size() && path.s[step + 1] <= s) ++step;
    const PathPoint point =
        path_point(path, step, (s - path.s[step]) / (path.s[step + 1] - path.s[step]));
    ASSERT_LT((found.trajectory.positions[k] - point.q).norm(), 1e-9);
    if (k > 0) {
      ASSERT_GT(s, found.progress[k - 1].s);
    }
  }
}

TEST(SampleSection, KeepsAllLimitsThatTheOptionsAskForFromRestToRest) {
  Random random;
  for (const Profile profile : testing::profiles) {
    for (const Interpolation interpolation : testing::interpolations) {
      for (const double rate : testing::rates) {
        for (int i = 0; i < testing::cases(2); ++i) {
          const double scale = random.integer(0, 2) == 0 ? random.uniform(0.3, 1) : 1;
          SCOPED_TRACE(name(profile) + ", " + name(interpolation) + ", " + number(rate) +
                       " Hz, scale " + number(scale) + ", case " + std::to_string(i));
          const RandomSection made = random_section(random, profile, interpolation, rate, scale);
          ASSERT_TRUE(made.timed.scaling) << made.timed.scaling.reason;
          const SampledSection found = sample_section(made.arm, made.timed, made.options);
          ASSERT_EQ(found.trajectory.interpolation(), interpolation);
          ASSERT_NO_FATAL_FAILURE(expect_times(found.trajectory.times, rate));
          ASSERT_NO_FATAL_FAILURE(expect_rest_at_ends(found.trajectory, made.timed.path));
          ASSERT_NO_FATAL_FAILURE(expect_on_path(found, made.timed.path));
          for (int order = 1; order <= 3; ++order) {
            ASSERT_LE(testing::asked_fraction(made.arm, found.trajectory, made.options, order),
                      1 + 1e-9)
                << "order " << order;
          }
        }
      }
    }
  }
}

/// The durations of the samples of some paths.
struct Durations {
  std::vector<double> least;     ///< the duration of the time scaling
  std::vector<double> expected;  ///< the same, or of one that keeps known limits of jerk
  std::vector<double> sampled;

  /// How much longer the samples take beyond so many seconds, as a fraction, at a quantile.
  double excess(double quantile, double allowed) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      all.push_back((sampled[i] - allowed) / expected[i] - 1);
    }
    std::sort(all.begin(), all.end());
    return all[std::size_t(quantile * double(all.size() - 1))];
  }
};

struct ProfileDurations {
  Durations jerk, fastest;
};

ProfileDurations measured_durations(Random& random, Interpolation interpolation, double rate,
                                    int count) {
  ProfileDurations both;
  for (int i = 0; i < count; ++i) {
    RandomSection made = random_section(random, Profile::jerk, interpolation, rate, 1);
    const auto& limits = made.arm.limits();
    const bool known_jerk = std::any_of(limits.begin(), limits.end(), [](const Limits& joint) {
      return joint.jerk < Limits::none;
    });
    double with_jerk = 0;
    for (const Profile profile : {Profile::jerk, Profile::fastest}) {
      made.timed.profile = profile;
      made.timed.scaling = time_scaling(made.timed.path, made.timed.limits, profile);
      made.options.timing.profile = profile;
      const double duration = made.timed.scaling.duration();
      if (profile == Profile::jerk) with_jerk = duration;
      Durations& durations = profile == Profile::jerk ? both.jerk : both.fastest;
      durations.least.push_back(duration);
      durations.expected.push_back(known_jerk ? std::max(duration, with_jerk) : duration);
      durations.sampled.push_back(
          sample_section(made.arm, made.timed, made.options).trajectory.times.back());
    }
  }
  return both;
}

// Not of linear joints: they keep limits of acceleration and jerk by divided differences, and the
// acceleration of `fastest` jumps.
TEST(SampleSection, TakesLittleLongerThanTheTimeScalingAndFastestNoLongerThanJerk) {
  Random random;
  const int count = testing::cases(20);
  for (const Interpolation interpolation : {Interpolation::cubic, Interpolation::quintic}) {
    for (const double rate : testing::rates) {
      const auto [jerk, fastest] = measured_durations(random, interpolation, rate, count);
      for (const Durations* durations : {&jerk, &fastest}) {
        SCOPED_TRACE((durations == &jerk ? "jerk, " : "fastest, ") + name(interpolation) + ", " +
                     number(rate) + " Hz");
        const double periods = rate > 0 ? 2 / rate : 0;
        if (count >= 10) {
          EXPECT_LE(durations->excess(0.9, periods), 0.03);
        }
        EXPECT_LE(durations->excess(1, periods), 0.1);
        // The grid of the path costs the time scaling of `fastest` up to a hundredth.
        const double below = durations == &jerk ? 1e-3 : 1e-2;
        for (std::size_t i = 0; i < durations->least.size(); ++i) {
          EXPECT_GE(durations->sampled[i], durations->least[i] * (1 - below)) << "case " << i;
        }
      }
      for (std::size_t i = 0; i < jerk.sampled.size(); ++i) {
        EXPECT_LE(fastest.sampled[i], jerk.sampled[i] * (1 + 1e-3)) << "case " << i;
      }
    }
  }
}

TEST(SampleSection, KeepsTheToolsSpeed) {
  Random random;
  for (const double rate : {0.0, 250.0}) {
    for (int i = 0; i < testing::cases(5); ++i) {
      const auto interpolation = testing::interpolations[1 + i % 2];
      RandomSection made = random_section(random, Profile::jerk, interpolation, rate, 1);
      const double limit = random.uniform(0.05, 0.5);
      made.options.tool_speeds = limit;
      made.timed = timed_section(made.arm, made.timed.path, made.options);
      const Trajectory motion = sample_section(made.arm, made.timed, made.options).trajectory;
      double largest = 0;
      for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
        constexpr double du = 1e-3;
        const double h = motion.times[k + 1] - motion.times[k];
        for (double u = 0; u < 1; u += 0.25) {
          const auto origin = [&](double at) -> Vector3 {
            return forward_kinematics(made.arm, testing::derivatives_between(motion, k, at, 0))
                .translation();
          };
          largest =
              std::max(largest, (origin(u + du) - origin(u)).norm() / (du * h) - 1e-12 / (du * h));
        }
      }
      EXPECT_LE(largest, limit * (1 + 1e-9));
      EXPECT_GE(largest, 0.5 * limit);
    }
  }
}

TEST(SampleSection, HasEveryRequiredSample) {
  Random random;
  for (int i = 0; i < testing::cases(30); ++i) {
    const auto interpolation = testing::interpolations[i % 3];
    RandomSection made = random_section(random, testing::profile_of_case(i), interpolation, 0, 1);
    const double length = made.timed.path.s.back();
    made.options.required.clear();
    for (int k = 1; k < 9; ++k) made.options.required.push_back(length * k / 9);
    const SampledSection found = sample_section(made.arm, made.timed, made.options);
    for (const double s : made.options.required) {
      const auto nearest = std::min_element(found.progress.begin(), found.progress.end(),
                                            [&](const ParameterState& a, const ParameterState& b) {
                                              return std::abs(a.s - s) < std::abs(b.s - s);
                                            });
      // Moved by the rounding of times to nanoseconds only.
      ASSERT_NEAR(nearest->s, s, 1e-9 * nearest->speed + 1e-12);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
