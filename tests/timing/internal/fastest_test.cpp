#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/timing/internal/fastest.h>

#include <hwy/targets.h>

#include <tests/path/random_joint_path.h>
#include <tests/refusal.h>

namespace beeline::internal {
namespace {

using testing::largest_fraction;
using testing::random_limits;
using testing::random_path;

TEST(Fastest, KeepsLimitsBetweenGridPointsAndUsesThem) {
  testing::Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const int joints = random.integer(1, 7);
    const JointPath path = random_path(random, joints, random.integer(3, 10));
    const PathLimits limits = random_limits(random, joints);
    const TimeScaling scaling = fastest(path, limits);
    ASSERT_FALSE(scaling.reason);
    ASSERT_EQ(scaling.s, path.s);
    ASSERT_EQ(scaling.speed.front(), 0);
    ASSERT_EQ(scaling.speed.back(), 0);
    for (std::size_t k = 1; k < scaling.t.size(); ++k) ASSERT_GT(scaling.t[k], scaling.t[k - 1]);
    const double fraction = largest_fraction(path, limits, scaling);
    ASSERT_LE(fraction, 1 + 1e-6);
    ASSERT_GE(fraction, 0.999);
  }
}

TEST(Fastest, IsTheSameOnEveryInstructionSet) {
  testing::Random random;
  for (int i = 0; i < testing::cases(60); ++i) {
    const int joints = random.integer(1, 17);
    const JointPath path = random_path(random, joints, random.integer(3, 10));
    const PathLimits limits = random_limits(random, joints);
    const TimeScaling scaling = fastest(path, limits);
    ASSERT_FALSE(scaling.reason);
    const double fraction = largest_fraction(path, limits, scaling);
    ASSERT_LE(fraction, 1 + 1e-6) << joints;
    ASSERT_GE(fraction, 0.999) << joints;
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const TimeScaling other = fastest(path, limits);
      hwy::SetSupportedTargetsForTest(0);
      ASSERT_FALSE(other.reason) << hwy::TargetName(target);
      ASSERT_NEAR(other.duration(), scaling.duration(), 1e-9 * scaling.duration())
          << hwy::TargetName(target);
    }
  }
}

TEST(Fastest, AlongAStraightLineIsTheTrapezoid) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int joints = random.integer(1, 7);
    const auto ends = testing::random_waypoints(random, joints, 2);
    const PathLimits limits = random_limits(random, joints);
    const JointPath line = refined(joint_spline(ends, chord_length(ends)), {.min_steps = 2000});
    const Configuration distance = (ends[1] - ends[0]).cwiseAbs();
    const double v =
        limits.velocity.cwiseQuotient(distance).minCoeff();  // in units of the distance
    const double a = limits.acceleration.cwiseQuotient(distance).minCoeff();
    const double closed = v * v < a ? 1 / v + v / a : 2 / std::sqrt(a);
    const double duration = fastest(line, limits).duration();
    ASSERT_GE(duration, closed * (1 - 1e-9));
    ASSERT_LE(duration, closed * (1 + 1e-3));
  }
}

TEST(Fastest, OfThePathReversedIsTheScalingReversed) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const int joints = random.integer(1, 7);
    const JointPath path = random_path(random, joints, random.integer(3, 10));
    const PathLimits limits = random_limits(random, joints);
    const TimeScaling there = fastest(path, limits),
                      back = fastest(testing::reversed(path), limits);
    ASSERT_NEAR(there.duration(), back.duration(), 3e-3 * there.duration());
    const double most = *std::max_element(there.speed.begin(), there.speed.end());
    double apart = 0;
    for (std::size_t k = 0; k < path.size(); ++k) {
      apart += std::abs(there.speed[k] - back.speed[path.size() - 1 - k]) / double(path.size());
    }
    ASSERT_LT(apart, 5e-3 * most);
  }
}

TEST(Fastest, ScalesItsDurationWithTheLimits) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const int joints = random.integer(1, 7);
    const JointPath path = random_path(random, joints, random.integer(3, 10));
    PathLimits limits = random_limits(random, joints);
    const double duration = fastest(path, limits).duration();
    const double c = random.uniform(0.1, 10);
    limits.velocity *= c;
    limits.acceleration *= c * c;
    ASSERT_NEAR(fastest(path, limits).duration(), duration / c, 1e-6 * duration / c);
  }
}

TEST(Fastest, IsNeverSlowerForWiderLimits) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const int joints = random.integer(1, 7);
    const JointPath path = random_path(random, joints, random.integer(3, 10));
    PathLimits limits = random_limits(random, joints);
    const double duration = fastest(path, limits).duration();
    const int joint = random.integer(0, joints - 1);
    limits.velocity[joint] *= 1.5;
    limits.acceleration[joint] *= 1.5;
    ASSERT_LE(fastest(path, limits).duration(), duration * (1 + 2e-3));
  }
}

TEST(Fastest, KeepsALimitOfItsSpeed) {
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    const JointPath path = random_path(random, 4, 5);
    PathLimits limits = random_limits(random, 4);
    for (std::size_t k = 0; k < path.size(); ++k) {
      limits.speed.push_back(random.uniform(0.2, 3));
    }
    const TimeScaling scaling = fastest(path, limits);
    ASSERT_TRUE(scaling);
    for (std::size_t k = 0; k < path.size(); ++k) {
      ASSERT_LE(scaling.speed[k], limits.speed[k] * (1 + 1e-12));
    }
  }
}

TEST(Fastest, BeginsAndEndsAsFastAsAskedOrSaysWhyNot) {
  testing::Random random;
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const JointPath path = random_path(random, 3, 5);
    const PathLimits limits = random_limits(random, 3);
    const EndSpeeds ends{random.uniform(0, 2), random.uniform(0, 2)};
    const TimeScaling scaling = fastest(path, limits, ends);
    if (!scaling) {
      ASSERT_TRUE(scaling.t.empty());
      continue;
    }
    ++found;
    ASSERT_NEAR(scaling.speed.front(), ends.begin, 1e-8);
    ASSERT_NEAR(scaling.speed.back(), ends.end, 1e-8);
    ASSERT_LE(largest_fraction(path, limits, scaling), 1 + 1e-5);
  }
  EXPECT_GT(found, 20);
  EXPECT_LT(found, 200);
}

TEST(Fastest, PassesStretchesWhereNothingMoves) {
  // There, still for a third of the parameter, and on: as 3 u^2 - 2 u^3 on both sides.
  JointPath path;
  const int steps = 300;
  for (int k = 0; k <= steps; ++k) {
    const double s = 3.0 * k / steps;
    const double u = s < 1 ? s : s < 2 ? 1 : s - 2;
    const double bend = s == 1 || s == 2 ? 0 : 6 - 12 * u;
    path.s.push_back(s);
    path.q.push_back(Configuration::Constant(2, (s < 2 ? 0 : 1) + u * u * (3 - 2 * u)));
    path.dq.push_back(Configuration::Constant(2, 6 * u * (1 - u)));
    path.ddq.push_back(Configuration::Constant(2, u == 1 ? 0 : bend));
  }
  PathLimits limits;
  limits.velocity = limits.acceleration = limits.jerk = Configuration::Constant(2, 1);
  const TimeScaling scaling = fastest(path, limits);
  ASSERT_FALSE(scaling.reason);
  // Two radians at 1 rad/s and 1 rad/s^2 take 3 s without the stop.
  EXPECT_GT(scaling.duration(), 2.9);
  EXPECT_LT(scaling.duration(), 4.5);
  for (std::size_t k = 1; k < scaling.t.size(); ++k) ASSERT_GT(scaling.t[k], scaling.t[k - 1]);
}

TEST(Fastest, TakesAMomentWhereNothingMovesAtAll) {
  const Configuration still = Configuration::Zero(1);
  const JointPath path{
      {0, 1, 2}, {still, still, still}, {still, still, still}, {still, still, still}};
  PathLimits limits;
  limits.velocity = limits.acceleration = limits.jerk = Configuration::Constant(1, 1);
  const TimeScaling scaling = fastest(path, limits);
  ASSERT_TRUE(scaling);
  EXPECT_GT(scaling.duration(), 0);
  EXPECT_LE(scaling.duration(), 0.01);
}

TEST(Fastest, RefusesWhatMakesNoSense) {
  testing::Random random;
  const JointPath path = random_path(random, 2, 4);
  PathLimits limits = random_limits(random, 2);
  EXPECT_REFUSED(fastest(path, limits, {.begin = -1}), "zero or more");
  limits.speed = {1, 2};
  EXPECT_REFUSED(fastest(path, limits), "has 2 limits of its speed");
  limits.speed.clear();
  limits.velocity[1] = 0;
  EXPECT_REFUSED(fastest(path, limits), "above zero");
  limits.velocity = Configuration::Constant(3, 1);
  EXPECT_REFUSED(fastest(path, limits), "a path of 2 joints");
}

}  // namespace
}  // namespace beeline::internal
