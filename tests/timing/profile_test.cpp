#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/time_scaling.h>

#include <tests/path/random_joint_path.h>
#include <tests/refusal.h>
#include <tests/timing/every_profile.h>

namespace beeline {
namespace {

using testing::profiles;

struct LimitedPath {
  JointPath path;
  PathLimits limits;
};
LimitedPath random_limited_path(testing::Random& random) {
  const int joints = random.integer(1, 7);
  LimitedPath made{testing::random_path(random, joints, random.integer(2, 6)),
                   testing::random_limits(random, joints)};
  for (int i = 0; i < joints; ++i) {
    made.limits.jerk[i] = made.limits.acceleration[i] * random.uniform(10, 500);
  }
  return made;
}

TEST(TimeScalingWithFractions, OfTheSameOneEverywhereIsThatOfLowerLimits) {
  testing::Random random;
  for (int i = 0; i < testing::cases(10); ++i) {
    auto [path, limits] = random_limited_path(random);
    const double fraction = random.uniform(0.2, 1);
    PathLimits lower = limits;
    lower.acceleration *= fraction;
    lower.jerk *= fraction;
    limits.fraction.assign(path.size(), fraction);
    for (const Profile profile : profiles) {
      const TimeScaling scaling = time_scaling(path, limits, profile);
      const TimeScaling expected = time_scaling(path, lower, profile);
      ASSERT_TRUE(scaling) << name(profile) << scaling.reason;
      const double duration = expected.duration();
      ASSERT_NEAR(scaling.duration(), duration, (profile == Profile::jerk ? 5e-3 : 1e-9) * duration)
          << name(profile);
    }
  }
}

/// The fraction of the limits that may be used at s.
double fraction_at(const JointPath& path, const PathLimits& limits, double s) {
  const auto next = std::upper_bound(path.s.begin() + 1, path.s.end() - 1, s);
  const auto k = std::size_t(next - path.s.begin());
  return std::lerp(limits.fraction[k - 1], limits.fraction[k],
                   (s - path.s[k - 1]) / (path.s[k] - path.s[k - 1]));
}

/// The acceleration of the joints at point i of the scaling, seen from the interval `step` of it.
Configuration joint_acceleration(const JointPath& path, const TimeScaling& scaling, std::size_t i,
                                 std::size_t step) {
  const double s = scaling.s[i], v = scaling.speed[i];
  const double a = scaling.smooth ? scaling.acceleration[i]
                                  : (scaling.speed[step + 1] - scaling.speed[step]) /
                                        (scaling.t[step + 1] - scaling.t[step]);
  const auto next = std::upper_bound(path.s.begin() + 1, path.s.end() - 1, s);
  const auto k = std::size_t(next - path.s.begin());
  const PathPoint point =
      path_point(path, k - 1, (s - path.s[k - 1]) / (path.s[k] - path.s[k - 1]));
  return point.dq * a + point.ddq * v * v;
}

/// The largest use of the limits that the fractions leave, of acceleration and of the mean jerk
/// between two points.
std::pair<double, double> used(const JointPath& path, const PathLimits& limits,
                               const TimeScaling& scaling) {
  double acceleration = 0, jerk = 0;
  const auto largest = [](const Configuration& value, const Configuration& limit) {
    return value.cwiseQuotient(limit).lpNorm<Eigen::Infinity>();
  };
  for (std::size_t k = 0; k + 1 < scaling.t.size(); ++k) {
    const Configuration a = joint_acceleration(path, scaling, k, k);
    const Configuration b = joint_acceleration(path, scaling, k + 1, k);
    const double left = fraction_at(path, limits, scaling.s[k]);
    const double right = fraction_at(path, limits, scaling.s[k + 1]);
    acceleration = std::max({acceleration, largest(a, limits.acceleration) / left,
                             largest(b, limits.acceleration) / right});
    if (!scaling.smooth) continue;
    const double dt = scaling.t[k + 1] - scaling.t[k];
    jerk = std::max(jerk, largest((b - a) / dt, limits.jerk) / std::max(left, right));
  }
  return {acceleration, jerk};
}

TEST(TimeScalingWithFractions, KeepsThemAndIsNoSlowerThanWithTheLeastEverywhere) {
  testing::Random random;
  for (int i = 0; i < testing::cases(10); ++i) {
    auto [path, limits] = random_limited_path(random);
    const double everywhere = random.uniform(0.2, 0.6), begin = random.uniform(0.2, 0.6);
    limits.fraction.assign(path.size(), everywhere);
    const PathLimits low = limits;
    for (std::size_t k = 0; k < path.size(); ++k) {
      const double u = path.s[k] / path.s.back();
      if (u < begin || u > begin + 0.2) limits.fraction[k] = 1;
    }
    for (const Profile profile : profiles) {
      const TimeScaling scaling = time_scaling(path, limits, profile);
      ASSERT_TRUE(scaling) << name(profile);
      const auto [acceleration, jerk] = used(path, limits, scaling);
      EXPECT_LE(acceleration, profile == Profile::jerk ? 1.02 : 1 + 1e-3) << name(profile);
      EXPECT_LE(jerk, 1.05) << name(profile);
      EXPECT_LE(scaling.duration(), time_scaling(path, low, profile).duration() * (1 + 1e-2))
          << name(profile);
    }
  }
}

// A speed limit far below what the accelerations allow: nearly all of the path at that speed.
TEST(TimeScalingWithSpeeds, HasTheShapeThatTheSpeedLimitNeeds) {
  testing::Random random;
  for (int i = 0; i < testing::cases(10); ++i) {
    auto [path, limits] = random_limited_path(random);
    const double fastest = time_scaling(path, limits, Profile::fastest).duration();
    const double speed = 0.01 * path.s.back() / fastest;
    limits.speed.assign(path.size(), speed);
    for (const Profile profile : profiles) {
      if (profile == Profile::quintic) continue;  // has one shape
      EXPECT_LE(time_scaling(path, limits, profile).duration(), 1.1 * path.s.back() / speed)
          << name(profile);
    }
  }
}

// Cancelled at any question, there is no time scaling or one that keeps the limits; questions alone
// change nothing.
TEST(TimeScalingWithBudget, IsNoneOrKeepsTheLimitsWhereverItIsCancelled) {
  testing::Random random;
  for (int i = 0; i < testing::cases(4); ++i) {
    LimitedPath made = random_limited_path(random);
    made.limits.fraction.assign(made.path.size(), 1);  // for used()
    const JointPath& path = made.path;
    const PathLimits& limits = made.limits;
    for (const Profile profile : profiles) {
      const TimeScaling whole = time_scaling(path, limits, profile);
      int asked = 0;
      const TimeScaling same =
          time_scaling(path, limits, profile, {.cancelled = [&] { return ++asked < 0; }});
      EXPECT_EQ(same.t, whole.t) << name(profile);
      EXPECT_EQ(same.speed, whole.speed) << name(profile);
      ASSERT_GT(asked, 1) << name(profile);
      for (int k = 0; k < 10; ++k) {
        int left = random.integer(0, asked - 1);
        const TimeScaling part =
            time_scaling(path, limits, profile, {.cancelled = [&] { return left-- <= 0; }});
        if (!part) {
          EXPECT_EQ(part.reason.code, ReasonCode::ended) << name(profile);
          EXPECT_TRUE(part.t.empty()) << name(profile);
          continue;
        }
        EXPECT_EQ(profile, Profile::jerk);
        EXPECT_GE(part.duration(), whole.duration() * (1 - 1e-9));
        EXPECT_LE(used(path, limits, part).first, 1.02);
      }
    }
  }
}

TEST(TimeScalingWithFractions, RefusesOthersThanOneForEachGridPointAboveZeroUpToOne) {
  testing::Random random;
  auto limited = random_limited_path(random);
  const auto& path = limited.path;
  auto& limits = limited.limits;
  for (const double refused : {0.0, -1.0, 1.01, std::nan("")}) {
    limits.fraction.assign(path.size(), 1);
    limits.fraction[1] = refused;
    EXPECT_REFUSED(check_limits(limits, path), "above 0 and at most 1");
  }
  limits.fraction.assign(path.size() - 1, 1);
  EXPECT_REFUSED(check_limits(limits, path), "fractions of its limits");
}

}  // namespace
}  // namespace beeline
