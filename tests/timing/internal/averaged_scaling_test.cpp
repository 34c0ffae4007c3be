#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/averaged_scaling.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using testing::Random;

/// From rest to rest with s strictly increasing, at uneven times. Smooth: of a speed that is a
/// sum of positive humps; else of speeds at the points.
TimeScaling random_scaling(Random& random, bool smooth) {
  TimeScaling scaling;
  scaling.smooth = smooth;
  scaling.s = {random.uniform(-1, 1)};
  scaling.t = scaling.speed = scaling.acceleration = {0};
  const int points = smooth ? 16 : random.integer(2, 12);
  const double shortest = smooth ? 0.5 : 0.05;
  for (int k = 1; k <= points; ++k) {
    scaling.t.push_back(scaling.t.back() + random.uniform(shortest, 1));
  }
  const double end = scaling.duration(), b = random.uniform(0, 0.9);
  // v = sin^2(pi t / T) (1 + b sin(2 pi t / T)), and its integral and derivative.
  const auto angle = [&](double t) { return M_PI * t / end; };
  const auto place = [&](double t) {
    const double x = angle(t), s = std::sin(x);
    return end / M_PI * (x / 2 - std::sin(2 * x) / 4 + b * s * s * s * s / 2);
  };
  for (std::size_t k = 1; k < scaling.t.size(); ++k) {
    const double t = scaling.t[k], x = angle(t), s = std::sin(x), c = std::cos(x);
    const bool last = k + 1 == scaling.t.size();
    if (smooth) {
      scaling.s.push_back(scaling.s.front() + place(t));
      scaling.speed.push_back(last ? 0 : s * s * (1 + 2 * b * s * c));
      scaling.acceleration.push_back(
          last ? 0 : M_PI / end * (2 * s * c + b * (6 * s * s * c * c - 2 * s * s * s * s)));
    } else {
      const double v = last ? 0 : random.uniform(0.1, 2), before = scaling.speed.back();
      scaling.s.push_back(scaling.s.back() + (t - scaling.t[k - 1]) * (v + before) / 2);
      scaling.speed.push_back(v);
      scaling.acceleration.push_back(0);
    }
  }
  return scaling;
}

double random_width(Random& random, const TimeScaling& scaling) {
  const int kind = random.integer(0, 3);
  if (kind == 0) return 0;
  return scaling.duration() * (kind == 1 ? 0.003 : random.uniform(0.001, 1.5));
}

/// s of the given scaling, constant outside it, by the basis polynomials of Hermite interpolation
/// or of constant acceleration.
double given_s(const TimeScaling& scaling, double t) {
  if (t <= 0) return scaling.s.front();
  if (t >= scaling.duration()) return scaling.s.back();
  std::size_t k = 0;
  while (scaling.t[k + 1] < t) ++k;
  const double h = scaling.t[k + 1] - scaling.t[k], u = (t - scaling.t[k]) / h, w = 1 - u;
  const double v0 = scaling.speed[k], v1 = scaling.speed[k + 1];
  if (!scaling.smooth) return scaling.s[k] + h * u * (v0 + u * (v1 - v0) / 2);
  const auto value = [](double x) { return x * x * x * (10 + x * (-15 + 6 * x)); };
  const auto slope = [](double x) { return x - x * x * x * (6 + x * (-8 + 3 * x)); };
  const auto curvature = [](double x) { return x * x * (0.5 + x * (-1.5 + x * (1.5 - 0.5 * x))); };
  return value(w) * scaling.s[k] + value(u) * scaling.s[k + 1] +
         h * (slope(u) * v0 - slope(w) * v1) +
         h * h *
             (curvature(u) * scaling.acceleration[k] + curvature(w) * scaling.acceleration[k + 1]);
}

/// The mean of s over the window before t, by the midpoint rule.
double mean_s(const TimeScaling& scaling, double width, double t) {
  if (width == 0) return given_s(scaling, t);
  constexpr int windows = 4000;
  double sum = 0;
  for (int i = 0; i < windows; ++i) sum += given_s(scaling, t - width * (i + 0.5) / windows);
  return sum / windows;
}

/// The highest derivative of the given scaling on both sides of point k: zero outside.
std::pair<double, double> sides(const TimeScaling& scaling, std::size_t k) {
  const auto highest = [&](std::size_t step, double u) {
    const double h = scaling.t[step + 1] - scaling.t[step];
    const double v0 = scaling.speed[step], v1 = scaling.speed[step + 1];
    if (!scaling.smooth) return (v1 - v0) / h;
    const double a0 = scaling.acceleration[step], a1 = scaling.acceleration[step + 1];
    const double ds = scaling.s[step + 1] - scaling.s[step];
    // The third derivatives of the basis polynomials at an end, all divided by h^3.
    const double at_begin = 60 * ds / h - 36 * v0 - 24 * v1 - h * (9 * a0 - 3 * a1);
    const double at_end = 60 * ds / h - 24 * v0 - 36 * v1 + h * (9 * a1 - 3 * a0);
    return (u == 0 ? at_begin : at_end) / (h * h);
  };
  const bool first = k == 0, last = k + 1 == scaling.t.size();
  return {first ? 0 : highest(k - 1, 1), last ? 0 : highest(k, 0)};
}

TEST(AveragedScaling, IsTheMovingAverageOfTheGivenOne) {
  Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const TimeScaling given = random_scaling(random, i % 2 == 0);
    const double width = random_width(random, given);
    const AveragedScaling scaling(given, width);
    ASSERT_DOUBLE_EQ(scaling.duration(), given.duration() + width);
    for (int j = 0; j < 20; ++j) {
      const double t = random.uniform(0, scaling.duration());
      ASSERT_NEAR(scaling.at(t).s, mean_s(given, width, t), 3e-6 * width * width + 1e-12)
          << "smooth: " << given.smooth << ", width " << width << ", t = " << t;
    }
  }
}

TEST(AveragedScaling, SpeedAndAccelerationAreTheDerivativesOfS) {
  Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const TimeScaling given = random_scaling(random, i % 2 == 0);
    const double width = random_width(random, given);
    const AveragedScaling scaling(given, width);
    const double d = std::min(1e-5, width > 0 ? width / 100 : 1);
    for (int j = 0; j < 50; ++j) {
      const double t = random.uniform(2 * d, scaling.duration() - 2 * d);
      const bool near_point = std::any_of(given.t.begin(), given.t.end(), [&](double point) {
        return std::abs(t - point) <= 2 * d || std::abs(t - point - width) <= 2 * d;
      });
      if (near_point) continue;
      const ParameterState before = scaling.at(t - d), now = scaling.at(t),
                           after = scaling.at(t + d);
      const double rounding =
          1e-15 * (1 + scaling.duration()) / (d * std::min(1.0, std::max(width, d)));
      ASSERT_NEAR((after.s - before.s) / (2 * d), now.speed, 1e-6 + rounding);
      ASSERT_NEAR((after.speed - before.speed) / (2 * d), now.acceleration, 1e-5 + rounding)
          << "smooth: " << given.smooth << ", width " << width;
    }
  }
}

TEST(AveragedScaling, IsFromRestToRest) {
  Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const TimeScaling given = random_scaling(random, i % 2 == 0);
    const double width = random_width(random, given);
    const AveragedScaling scaling(given, width);
    const ParameterState begin = scaling.at(0), end = scaling.at(scaling.duration());
    EXPECT_DOUBLE_EQ(begin.s, given.s.front());
    EXPECT_NEAR(end.s, given.s.back(), 1e-14 * (1 + std::abs(end.s)));
    EXPECT_EQ(begin.speed, 0);
    EXPECT_NEAR(end.speed, 0, 1e-12);
    if (width == 0 && !given.smooth) continue;  // d2s/dt2 jumps there
    EXPECT_EQ(begin.acceleration, 0);
    EXPECT_NEAR(end.acceleration, 0, 1e-10);
  }
}

TEST(AveragedScaling, TimeOfIsTheInverse) {
  Random random;
  for (int i = 0; i < testing::cases(100); ++i) {
    const TimeScaling given = random_scaling(random, i % 2 == 0);
    const AveragedScaling scaling(given, random_width(random, given));
    for (int j = 0; j < 20; ++j) {
      const double t = random.uniform(0, scaling.duration());
      const ParameterState now = scaling.at(t);
      const double found = scaling.time_of(now.s);
      ASSERT_NEAR(scaling.at(found).s, now.s, 1e-13);
      if (now.speed > 1e-2) {
        ASSERT_NEAR(found, t, 1e-11);
      }
    }
  }
}

TEST(AveragedScaling, KinksAreTheJumpsAboveTheFractionAndTheWidthLater) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const TimeScaling given = random_scaling(random, i % 2 == 0);
    const double width = random_width(random, given), fraction = random.uniform(0, 0.5);
    const AveragedScaling scaling(given, width);
    double largest = 0;
    for (std::size_t k = 0; k < given.t.size(); ++k) {
      const auto [before, after] = sides(given, k);
      largest = std::max({largest, std::abs(before), std::abs(after)});
    }
    std::vector<double> expected;
    for (std::size_t k = 0; k < given.t.size(); ++k) {
      const auto [before, after] = sides(given, k);
      if (!(std::abs(after - before) > fraction * largest)) continue;
      for (const double t : {given.t[k], given.t[k] + width}) {
        if (t > 0 && t < scaling.duration()) expected.push_back(t);
      }
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    ASSERT_EQ(scaling.kinks(fraction), expected) << "smooth: " << given.smooth;
  }
}

// Between its kinks the average of a piecewise constant d2s/dt2 is linear in time.
TEST(AveragedScaling, AccelerationIsLinearBetweenKinks) {
  Random random;
  for (int i = 0; i < testing::cases(100); ++i) {
    const TimeScaling given = random_scaling(random, false);
    const double width = given.duration() * random.uniform(0.01, 1.5);
    const AveragedScaling scaling(given, width);
    std::vector<double> times = scaling.kinks(0);
    times.insert(times.begin(), 0);
    times.push_back(scaling.duration());
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      const double h = times[k + 1] - times[k];
      const auto acceleration = [&](double u) { return scaling.at(times[k] + u * h).acceleration; };
      ASSERT_NEAR(acceleration(0.5), (acceleration(0.1) + acceleration(0.9)) / 2, 1e-9);
    }
  }
}

}  // namespace
}  // namespace beeline::internal
