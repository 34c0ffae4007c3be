#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/point_to_point.h>

#include <tests/path/random_joint_path.h>

namespace beeline::internal {
namespace {

PathLimits with_jerk(testing::Random& random, PathLimits limits) {
  for (double& jerk : limits.jerk) jerk = random.uniform(20, 2000);
  return limits;
}

/// The largest fraction of a limit, from differences of the points of the scaling.
double largest_fraction_with_jerk(const JointPath& path, const PathLimits& limits,
                                  const TimeScaling& scaling) {
  double largest = 0;
  std::size_t step = 0;
  Configuration acceleration_before, velocity_before;
  for (std::size_t i = 0; i < scaling.t.size(); ++i) {
    while (step + 2 < path.size() && path.s[step + 1] <= scaling.s[i]) ++step;
    const PathPoint point =
        path_point(path, step, (scaling.s[i] - path.s[step]) / (path.s[step + 1] - path.s[step]));
    const double v = scaling.speed[i], a = scaling.acceleration[i];
    const Configuration velocity = point.dq * v, acceleration = point.dq * a + point.ddq * v * v;
    const auto fraction = [](const Configuration& value, const Configuration& limit) {
      return value.cwiseQuotient(limit).lpNorm<Eigen::Infinity>();
    };
    largest = std::max({largest, fraction(velocity, limits.velocity),
                        fraction(acceleration, limits.acceleration)});
    if (i > 0 && scaling.smooth) {
      const double dt = scaling.t[i] - scaling.t[i - 1];
      largest = std::max({largest, fraction((acceleration - acceleration_before) / dt, limits.jerk),
                          fraction((velocity - velocity_before) / dt, limits.acceleration)});
    }
    acceleration_before = acceleration;
    velocity_before = velocity;
  }
  return largest;
}

TEST(ScalarProfile, KeepsTheLimitsAndUsesThemFromRestToRest) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const int joints = random.integer(1, 7);
    const JointPath path = testing::random_path(random, joints, random.integer(2, 8));
    const PathLimits limits = with_jerk(random, testing::random_limits(random, joints));
    for (const auto form : {ScalarForm::trapezoidal, ScalarForm::quintic, ScalarForm::s_curve}) {
      const TimeScaling scaling = scalar_profile(form, path, limits);
      ASSERT_EQ(scaling.speed.front(), 0);
      ASSERT_EQ(scaling.speed.back(), 0);
      ASSERT_EQ(scaling.s.back(), path.s.back());
      for (std::size_t k = 1; k < scaling.t.size(); ++k) {
        ASSERT_GT(scaling.t[k], scaling.t[k - 1]);
        ASSERT_GT(scaling.s[k], scaling.s[k - 1]);
      }
      const double fraction = largest_fraction_with_jerk(path, limits, scaling);
      ASSERT_LE(fraction, 1 + 1e-3);
      ASSERT_GE(fraction, 0.8);
    }
  }
}

TEST(ScalarProfile, AlongAStraightLineIsTheClosedForm) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const int joints = random.integer(1, 7);
    const auto ends = testing::random_waypoints(random, joints, 2);
    const PathLimits limits = with_jerk(random, testing::random_limits(random, joints));
    const JointPath line = refined(joint_spline(ends, chord_length(ends)));
    const Configuration distance = (ends[1] - ends[0]).cwiseAbs();
    Limits limits_along;
    limits_along.velocity = limits.velocity.cwiseQuotient(distance).minCoeff();
    limits_along.acceleration = limits.acceleration.cwiseQuotient(distance).minCoeff();
    const double trapezoid = s_curve(1, limits_along).duration;
    limits_along.jerk = limits.jerk.cwiseQuotient(distance).minCoeff();
    const double rounded = s_curve(1, limits_along).duration;
    ASSERT_NEAR(scalar_profile(ScalarForm::trapezoidal, line, limits).duration(), trapezoid,
                2e-3 * trapezoid);
    ASSERT_NEAR(scalar_profile(ScalarForm::s_curve, line, limits).duration(), rounded,
                5e-3 * rounded);
    ASSERT_GE(scalar_profile(ScalarForm::trapezoidal, line, limits).duration(),
              trapezoid * (1 - 1e-9));
  }
}

TEST(ScalarProfile, IsNeverQuickerThanTheFastest) {
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const JointPath path = testing::random_path(random, 3, 5);
    const PathLimits limits = with_jerk(random, testing::random_limits(random, 3));
    const double least = fastest(path, limits).duration();
    const double trapezoid = scalar_profile(ScalarForm::trapezoidal, path, limits).duration();
    const double rounded = scalar_profile(ScalarForm::s_curve, path, limits).duration();
    const double quintic = scalar_profile(ScalarForm::quintic, path, limits).duration();
    ASSERT_LE(least, trapezoid * (1 + 5e-3));
    ASSERT_LE(least, rounded * (1 + 5e-3));
    ASSERT_LE(least, quintic);
  }
}

}  // namespace
}  // namespace beeline::internal
