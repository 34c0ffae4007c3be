#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/averaged_scaling.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/jerk_limited.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/timing/point_to_point.h>

#include <tests/path/random_joint_path.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

/// A path of 2 to 7 waypoints, with limits of jerk that take 2 ms to 100 ms to full acceleration.
struct Case {
  JointPath path;
  PathLimits limits;
};
Case random_case(testing::Random& random) {
  const int joints = random.integer(1, 7);
  Case made{testing::random_path(random, joints, random.integer(2, 7)),
            testing::random_limits(random, joints)};
  for (int i = 0; i < joints; ++i) {
    made.limits.jerk[i] = made.limits.acceleration[i] * random.uniform(10, 500);
  }
  return made;
}

double largest_fraction(const Configuration& value, const Configuration& limit) {
  return value.cwiseQuotient(limit).lpNorm<Eigen::Infinity>();
}

/// Stairs of length one of both joints in turn; the corners are rounded from `size` before to
/// `size` behind.
JointPath staircase(int corners, double size) {
  JointPath path;
  Eigen::Vector2d corner(0, 0);
  const auto add = [&](double s, const Eigen::Vector2d& q, const Eigen::Vector2d& direction) {
    path.s.push_back(s);
    path.q.push_back(q);
    path.dq.push_back(direction);
    path.ddq.push_back(Eigen::Vector2d::Zero());
  };
  for (int i = 0; i <= corners; ++i) {
    const Eigen::Vector2d direction = i % 2 == 0 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
    const double rounding = 1.7 * size, begin = i == 0 ? 0 : path.s.back() + rounding;
    const double skipped = i == 0 ? 0 : size, left = i == corners ? 0 : size;
    add(begin, corner + skipped * direction, direction);
    add(begin + 1 - skipped - left, corner + (1 - left) * direction, direction);
    corner += direction;
  }
  return path;
}

/// What the arm does at a point of the scaling.
struct State {
  Configuration velocity, acceleration;
};
State state_at(const JointPath& path, const TimeScaling& scaling, std::size_t i,
               std::size_t& step) {
  while (step + 2 < path.size() && path.s[step + 1] <= scaling.s[i]) ++step;
  const double along = (scaling.s[i] - path.s[step]) / (path.s[step + 1] - path.s[step]);
  const PathPoint point = path_point(path, step, along);
  const double v = scaling.speed[i];
  return {point.dq * v, point.dq * scaling.acceleration[i] + point.ddq * v * v};
}

void expect_limits_kept(const JointPath& path, const PathLimits& limits,
                        const TimeScaling& scaling) {
  ASSERT_FALSE(scaling.reason);
  ASSERT_EQ(scaling.speed.front(), 0);
  ASSERT_EQ(scaling.speed.back(), 0);
  std::size_t step = 0;
  State before = state_at(path, scaling, 0, step);
  ASSERT_LT(before.acceleration.norm(), 1e-9);
  for (std::size_t k = 1; k < scaling.t.size(); ++k) {
    const State now = state_at(path, scaling, k, step);
    const double dt = scaling.t[k] - scaling.t[k - 1];
    ASSERT_GT(dt, 0);
    ASSERT_LE(largest_fraction(now.velocity, limits.velocity), 1 + 1e-5);
    ASSERT_LE(largest_fraction(now.acceleration, limits.acceleration), 1 + 1e-4);
    ASSERT_LE(largest_fraction((now.velocity - before.velocity) / dt, limits.acceleration),
              1 + 1e-3);
    ASSERT_LE(largest_fraction((now.acceleration - before.acceleration) / dt, limits.jerk),
              1 + 1e-3);
    before = now;
  }
  ASSERT_LT(before.acceleration.norm(), 1e-9);
}

TEST(JerkLimited, KeepsAllLimitsAtItsPointsAndBetween) {
  testing::Random random;
  for (int i = 0; i < 25; ++i) {
    const auto [path, limits] = random_case(random);
    expect_limits_kept(path, limits, jerk_limited(path, limits));
  }
}

TEST(JerkLimited, KeepsAllLimitsOnDenseSamples) {
  constexpr double between_points = 1.1;
  testing::Random random;
  for (int i = 0; i < 25; ++i) {
    auto [path, limits] = random_case(random);
    if (i % 3 == 1) limits.velocity[0] = Limits::none;
    if (i % 3 == 2) limits.acceleration[0] = Limits::none;
    const TimeScaling scaling = jerk_limited(path, limits);
    const AveragedScaling motion(scaling, 0);
    constexpr int count = 20'000;
    const double dt = scaling.duration() / count;
    Configuration before;
    for (int k = 0; k <= count; ++k) {
      const ParameterState now = motion.at(k * dt);
      const auto next = std::upper_bound(path.s.begin() + 1, path.s.end() - 1, now.s);
      const auto step = static_cast<std::size_t>(next - path.s.begin()) - 1;
      const PathPoint point =
          path_point(path, step, (now.s - path.s[step]) / (path.s[step + 1] - path.s[step]));
      const Configuration v = now.speed * point.dq;
      const Configuration a = now.acceleration * point.dq + now.speed * now.speed * point.ddq;
      ASSERT_LE(largest_fraction(v, limits.velocity), 1 + 5e-3);
      ASSERT_LE(largest_fraction(a, limits.acceleration), 1 + 2e-2);
      // See jerk_limited.h about the quintic between two points of the scaling.
      if (k > 0) {
        ASSERT_LE(largest_fraction((a - before) / dt, limits.jerk), between_points);
      }
      before = a;
    }
  }
}

TEST(JerkLimited, KeepsALimitOfTheSpeedAlongThePath) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    auto [path, limits] = random_case(random);
    for (std::size_t k = 0; k < path.size(); ++k) {
      limits.speed.push_back(0.5 + 0.4 * std::sin(10 * path.s[k]));
    }
    const TimeScaling scaling = jerk_limited(path, limits);
    std::size_t seen = 0;
    for (std::size_t k = 0; k < scaling.s.size(); ++k) {
      const auto at = std::lower_bound(path.s.begin(), path.s.end(), scaling.s[k]);
      if (*at != scaling.s[k]) continue;
      ++seen;
      ASSERT_LE(scaling.speed[k], limits.speed[std::size_t(at - path.s.begin())] * (1 + 1e-6));
    }
    ASSERT_EQ(seen, path.size());
  }
}

TEST(JerkLimited, IsNearTheResultOnAFinerPath) {
  testing::Random random;
  for (int i = 0; i < testing::cases(10); ++i) {
    const auto [path, limits] = random_case(random);
    RefineOptions finer;
    finer.min_steps = 4000;
    const double duration = jerk_limited(path, limits).duration();
    ASSERT_NEAR(jerk_limited(refined(path, finer), limits).duration(), duration, 2e-2 * duration);
  }
}

TEST(JerkLimited, IsNoSlowerThanSimplerProfilesAndNearTheFastest) {
  testing::Random random;
  double sum = 0;
  constexpr int count = 25;
  for (int i = 0; i < count; ++i) {
    const auto [path, limits] = random_case(random);
    const double duration = jerk_limited(path, limits).duration();
    ASSERT_LE(duration, scalar_profile(ScalarForm::s_curve, path, limits).duration() * (1 + 2e-3));
    ASSERT_LE(duration, scalar_profile(ScalarForm::quintic, path, limits).duration());
    const double least = fastest(path, limits).duration();
    ASSERT_GE(duration, least * (1 - 1e-2));  // except what a coarse grid costs the fastest
    sum += duration / least;
  }
  EXPECT_LT(sum / count, 1.1);
}

TEST(JerkLimited, AlongAStraightLineIsTheClosedFormOfSevenPhases) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    auto [path, limits] = random_case(random);
    const auto ends = testing::random_waypoints(random, int(limits.velocity.size()), 2);
    const JointPath line = refined(joint_spline(ends, chord_length(ends)));
    const Configuration distance = (ends[1] - ends[0]).cwiseAbs();
    Limits limits_along;
    limits_along.velocity = limits.velocity.cwiseQuotient(distance).minCoeff();
    limits_along.acceleration = limits.acceleration.cwiseQuotient(distance).minCoeff();
    limits_along.jerk = limits.jerk.cwiseQuotient(distance).minCoeff();
    const double closed = s_curve(1, limits_along).duration;
    ASSERT_NEAR(jerk_limited(line, limits).duration(), closed, 3e-3 * closed);
  }
}

// Little longer than with stops at the corners, however tightly these are rounded.
TEST(JerkLimited, PassesTightCornersAsWellAsStopsThere) {
  const PathLimits limits{
      Eigen::Vector2d(2, 2), Eigen::Vector2d(8, 8), Eigen::Vector2d(60, 60), {}};
  const double along_one = jerk_limited(refined(staircase(0, 0)), limits).duration();
  for (const int corners : {1, 4, 9}) {
    for (const double size : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const JointPath path = refined(staircase(corners, size));
      const TimeScaling scaling = jerk_limited(path, limits);
      expect_limits_kept(path, limits, scaling);
      const double stopping = (corners + 1) * along_one;
      EXPECT_LT(scaling.duration(), 1.2 * stopping) << corners << " corners of " << size;
    }
  }
}

TEST(JerkLimited, ScalesItsDurationWithTheLimits) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    auto [path, limits] = random_case(random);
    const double duration = jerk_limited(path, limits).duration();
    const double c = random.uniform(0.2, 5);
    limits.velocity *= c;
    limits.acceleration *= c * c;
    limits.jerk *= c * c * c;
    ASSERT_NEAR(jerk_limited(path, limits).duration(), duration / c, 5e-3 * duration / c);
  }
}

TEST(JerkLimited, OfThePathReversedTakesAsLong) {
  testing::Random random;
  for (int i = 0; i < 10; ++i) {
    const auto [path, limits] = random_case(random);
    const double there = jerk_limited(path, limits).duration();
    ASSERT_NEAR(jerk_limited(testing::reversed(path), limits).duration(), there, 2e-2 * there);
  }
}

TEST(JerkLimited, KeepsTheSmallestLimitsAndRefusesSmallerOnes) {
  testing::Random random;
  const auto limited = random_case(random);
  const auto& path = limited.path;
  const auto& limits = limited.limits;
  for (Configuration PathLimits::*kind :
       {&PathLimits::velocity, &PathLimits::acceleration, &PathLimits::jerk}) {
    PathLimits tiny = limits;
    (tiny.*kind)[0] = 1e-100;
    const TimeScaling scaling = jerk_limited(path, tiny);
    ASSERT_TRUE(scaling);
    EXPECT_GT(scaling.duration(), 1e30);
    EXPECT_TRUE(std::isfinite(scaling.duration()));
    for (const double refused : {1e-310, 0.0, -1.0, std::nan("")}) {
      (tiny.*kind)[0] = refused;
      EXPECT_REFUSED(jerk_limited(path, tiny), "above zero");
    }
  }
}

TEST(JerkLimited, NeedsALimitOfJerk) {
  testing::Random random;
  const JointPath path = testing::random_path(random, 2, 4);
  EXPECT_REFUSED(jerk_limited(path, testing::random_limits(random, 2)), "none of the joints");
}

}  // namespace
}  // namespace beeline::internal
