#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/allocations.h>
#include <tests/random.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

constexpr Synchronise both_ways[] = {Synchronise::time, Synchronise::straight};

/// A built-in arm as it is, or with some random limits, also infinite ones.
Arm random_arm_limits(testing::Random& random, const std::string& name) {
  const Arm plain = built_in(name);
  if (random.integer(0, 3) == 0) return plain;
  std::vector<Joint> joints = plain.joints();
  for (Joint& joint : joints) {
    for (double* limit : {&joint.limits.velocity, &joint.limits.acceleration, &joint.limits.jerk}) {
      *limit = random.integer(0, 4) == 0 ? Limits::none : random.uniform(0.1, 10);
    }
  }
  return {name, joints, plain.tool(), plain.base()};
}

/// A goal with, now and then, joints that stay.
Configuration random_goal(testing::Random& random, const Arm& arm, const Configuration& from) {
  Configuration to = random.configuration(arm);
  for (Eigen::Index k = 0; k < to.size(); ++k) {
    if (random.integer(0, 4) == 0) to[k] = from[k];
  }
  return to;
}

double max_velocity(const Limits& limits) {
  return std::isfinite(limits.velocity) ? limits.velocity : assumed_velocity_limit;
}

double own_duration(const Limits& limits, double distance) {
  return s_curve(distance, {.velocity = max_velocity(limits),
                            .acceleration = limits.acceleration,
                            .jerk = limits.jerk})
      .duration;
}

void expect_limits_kept(const Arm& arm, const PointToPoint& motion) {
  if (motion.duration == 0) return;
  const double slack = 1 + 1e-12, tiny = 1e-12;
  Configuration q(arm.dof()), v = q, a = q, last_q = q, last_v = q, last_a = q;
  const int samples = 200;
  for (int k = 0; k <= samples; ++k) {
    at(motion, motion.duration * k / samples, q, v, a);
    const double h = motion.duration / samples;
    for (int i = 0; i < arm.dof(); ++i) {
      const Limits& limits = arm.limits(i);
      ASSERT_LE(std::abs(v[i]), max_velocity(limits) * slack) << i;
      ASSERT_LE(std::abs(a[i]), limits.acceleration * slack) << i;
      if (k == 0) continue;
      ASSERT_LE(std::abs(q[i] - last_q[i]), max_velocity(limits) * h * slack + tiny);
      ASSERT_LE(std::abs(v[i] - last_v[i]), limits.acceleration * h * slack + tiny);
      ASSERT_LE(std::abs(a[i] - last_a[i]), limits.jerk * h * slack + tiny);
    }
    last_q = q, last_v = v, last_a = a;
  }
}

template <class Check>
void for_random_motions(int count, Check check) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    for (int i = 0; i < count; ++i) {
      const Arm arm = random_arm_limits(random, name);
      const Configuration from = random.configuration(arm);
      check(arm, from, random_goal(random, arm, from));
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(PointToPoint, KeepsTheLimitsOfEveryBuiltInArm) {
  for_random_motions(60, [](const Arm& arm, const auto& from, const auto& to) {
    for (const Synchronise synchronise : both_ways) {
      expect_limits_kept(arm, point_to_point(arm, from, to, {synchronise}));
    }
  });
}

TEST(PointToPoint, LastsAsLongAsTheSlowestJointAndStraightNoLess) {
  for_random_motions(100, [](const Arm& arm, const auto& from, const auto& to) {
    double slowest = 0;
    for (int k = 0; k < arm.dof(); ++k) {
      const Limits limits = motion_limits(arm.limits(k));
      slowest = std::max(slowest, own_duration(limits, to[k] - from[k]));
    }
    const PointToPoint motion = point_to_point(arm, from, to);
    ASSERT_EQ(motion.duration, slowest);
    ASSERT_GE(point_to_point(arm, from, to, {Synchronise::straight}).duration,
              slowest * (1 - 1e-12));
    for (const SCurve& curve : motion.curves) ASSERT_EQ(curve.duration, motion.duration);
  });
}

TEST(PointToPoint, BeginsAndEndsExactlyAndTheWayBackIsTheSame) {
  for_random_motions(50, [](const Arm& arm, const auto& from, const auto& to) {
    Configuration q(arm.dof()), v = q, a = q, back_q = q;
    for (const Synchronise synchronise : both_ways) {
      const PointToPoint motion = point_to_point(arm, from, to, {synchronise});
      for (const double t : {-1.0, 0.0, motion.duration, motion.duration + 1, Limits::none}) {
        at(motion, t, q, v, a);
        ASSERT_EQ(q, t > 0 || motion.duration == 0 ? to : from);
        ASSERT_TRUE(v.isZero(0) && a.isZero(0));
      }
      PointToPoint back = motion;
      point_to_point(arm, back.to, back.from, back, {synchronise});
      ASSERT_EQ(back.from, to);
      ASSERT_EQ(back.to, from);
      ASSERT_EQ(back.duration, motion.duration);
      for (const double fraction : {0.1, 0.25, 0.4, 0.5, 0.8}) {
        at(motion, fraction * motion.duration, q, v, a);
        at(back, (1 - fraction) * motion.duration, back_q, v, a);
        ASSERT_LT((q - back_q).norm(), 1e-12);
      }
    }
  });
}

TEST(PointToPoint, StraightIsAStraightLineAtTheLimitOfSomeJoint) {
  for_random_motions(50, [](const Arm& arm, const auto& from, const auto& to) {
    const PointToPoint motion = point_to_point(arm, from, to, {Synchronise::straight});
    Configuration q(arm.dof()), v = q, a = q;
    const Configuration distance = to - from;
    if (distance.isZero(0)) return;
    for (int k = 0; k <= 50; ++k) {
      at(motion, motion.duration * k / 50, q, v, a);
      const double fraction = distance.dot(q - from) / distance.squaredNorm();
      ASSERT_LT((q - from - fraction * distance).norm(), 1e-12);
    }
    // Each kind of limit that the curve is at, some joint is at.
    double v_used = 0, a_used = 0, j_used = 0;
    for (std::size_t k = 0; k < motion.curves.size(); ++k) {
      const SCurve& curve = motion.curves[k];
      if (curve.distance == 0) continue;
      const Limits limits = motion_limits(arm.limits(k));
      v_used = std::max(v_used, std::abs(curve.velocity) / max_velocity(limits));
      if (std::isfinite(limits.acceleration)) {
        a_used = std::max(a_used, std::abs(curve.acceleration) / limits.acceleration);
      }
      if (std::isfinite(limits.jerk)) j_used = std::max(j_used, std::abs(curve.jerk) / limits.jerk);
    }
    const SCurve& curve = motion.curves[0];
    ASSERT_LE(std::max({v_used, a_used, j_used}), 1 + 1e-12);
    if (curve.cruise_time > 0) {
      ASSERT_NEAR(v_used, 1, 1e-12);
    }
    if (curve.acceleration_time > 0) {
      ASSERT_NEAR(a_used, 1, 1e-12);
    }
    if (curve.jerk_time > 0) {
      ASSERT_NEAR(j_used, 1, 1e-12);
    }
  });
}

TEST(PointToPoint, WithOneJointBothWaysAreOne) {
  testing::Random random;
  PointToPoint time, straight;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Limits> limits{{.velocity = random.uniform(0.1, 3),
                                      .acceleration = random.uniform(0.1, 3),
                                      .jerk = random.uniform(0.1, 3)}};
    const Configuration from = Configuration::Constant(1, random.uniform(-3, 3)),
                        to = Configuration::Constant(1, random.uniform(-3, 3));
    point_to_point(limits, from, to, time);
    point_to_point(limits, from, to, straight, {Synchronise::straight});
    ASSERT_EQ(time.duration, straight.duration);
    ASSERT_EQ(time.curves[0].velocity, straight.curves[0].velocity);
  }
}

TEST(PointToPoint, AssumesLimitsThatAreNotKnown) {
  // At the speed v = 1, after v / 0.25 s of acceleration and 0.1 s to that.
  const double slower = assumed_time_to_velocity + assumed_time_to_acceleration;
  const Arm arm = built_in("rrr");
  const Configuration from = Configuration::Zero(3), to = Configuration::Constant(3, 0.5);
  for (const Synchronise synchronise : both_ways) {
    EXPECT_NEAR(point_to_point(arm, from, to, {synchronise}).duration,
                0.5 / assumed_velocity_limit + slower, 1e-12);
    EXPECT_EQ(point_to_point(arm, from, from, {synchronise}).duration, 0);
  }
}

TEST(Sampled, IsATrajectoryThatEndsExactlyAtTheGoal) {
  testing::Random random;
  for_random_motions(30, [&random](const Arm& arm, const auto& from, const auto& to) {
    const PointToPoint motion = point_to_point(arm, from, to);
    const double rate =
        random.integer(0, 1) == 0 ? random.uniform(1, 300) : 8 / std::max(motion.duration, 1e-3);
    const Trajectory trajectory = sampled(arm, motion, rate);
    ASSERT_NO_THROW(check_trajectory(trajectory));
    ASSERT_EQ(trajectory.positions.back(), to);
    ASSERT_TRUE(trajectory.velocities.back().isZero(0));
    if (motion.duration == 0) return;
    ASSERT_EQ(trajectory.positions.front(), from);
    ASSERT_TRUE(trajectory.velocities.front().isZero(0));
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      ASSERT_NEAR(trajectory.times[k], double(k) / rate, 1e-9);
    }
    const LimitUsage usage = limit_usage(arm, trajectory);
    ASSERT_LE(usage.velocity.fraction, 1 + 1e-9);
    ASSERT_LE(usage.acceleration.fraction, 1 + 1e-9);
    ASSERT_LE(usage.jerk.fraction, 1 + 1e-9);
    // Few samples cannot follow the motion.
    const double few = motion.duration * rate < 20 ? motion.duration : 0.05 * motion.duration;
    ASSERT_LE(trajectory.times.back(), motion.duration + 3 / rate + few);
  });
}

#if BEELINE_COUNTS_ALLOCATIONS
TEST(PointToPoint, PlansAndTellsItsStateWithoutAllocating) {
  testing::Random random;
  const Arm arm = built_in("panda");
  PointToPoint motion;
  Configuration q(arm.dof()), v = q, a = q;
  std::vector<Configuration> goals;
  for (int i = 0; i < 100; ++i) goals.push_back(random.configuration(arm));
  point_to_point(arm, goals[0], goals[1], motion);
  const long before = allocations;
  for (std::size_t i = 1; i < goals.size(); ++i) {
    for (const Synchronise synchronise : both_ways) {
      point_to_point(arm, goals[i - 1], goals[i], motion, {synchronise});
      at(motion, motion.duration / 3, q, v, a);
      point_to_point(arm.limits(), goals[i - 1], goals[i], motion, {synchronise});
    }
  }
  EXPECT_EQ(allocations, before);
}
#endif

TEST(PointToPoint, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm);
  Configuration far = q;
  far[3] = 1;
  PointToPoint motion;
  EXPECT_REFUSED(point_to_point(arm, Configuration::Zero(6), q), "7 joint values");
  EXPECT_REFUSED(point_to_point(arm, far, q), "cannot start: ");
  EXPECT_REFUSED(point_to_point(arm, q, far), "cannot end: ");
  EXPECT_REFUSED(point_to_point(arm.limits(), q, far, motion), "the end: joint 4 at 1 is outside");
  EXPECT_REFUSED(point_to_point(arm.limits(), Configuration::Zero(2), q, motion), "7 joints");
  far[3] = NAN;
  EXPECT_REFUSED(point_to_point(arm, q, far), "finite");
  EXPECT_REFUSED(point_to_point(arm.limits(), q, far, motion), "joint 4 at nan");
  const std::vector<Limits> stuck{{.velocity = 1}, {.jerk = 0}};
  const Configuration zero = Configuration::Zero(2), one = Configuration::Ones(2);
  EXPECT_REFUSED(point_to_point(stuck, zero, zero, motion), "joint 2 has");
  for (const Synchronise synchronise : both_ways) {
    const std::vector<Limits> free(2);
    EXPECT_REFUSED(
        point_to_point(free, zero, Configuration::Constant(2, INFINITY), motion, {synchronise}),
        "finite");
  }
  motion = point_to_point(arm, q, q);
  Configuration v = q, a = q, small(6);
  EXPECT_REFUSED(at(motion, 0, small, v, a), "7 joints");
  EXPECT_REFUSED(at(motion, NAN, far, v, a), "NaN");
  EXPECT_REFUSED(sampled(arm, motion, 0), "rate");
  EXPECT_REFUSED(sampled(built_in("rrr"), motion, 100), "3 joint values");
  motion.duration = 1e6;
  EXPECT_REFUSED(sampled(arm, motion, 100), "lower the rate");
}

}  // namespace
}  // namespace beeline
