#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/motion/time_law.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(RestToRest, StartsAndEndsAtRestWithoutAcceleration) {
  EXPECT_EQ(rest_to_rest(0), 0);
  EXPECT_EQ(rest_to_rest(1), 1);
  EXPECT_EQ(rest_to_rest(0.5), 0.5);
  const double h = 1e-3;
  const auto slope = [&](double u) {
    return (rest_to_rest(u + h) - rest_to_rest(u - h)) / (2 * h);
  };
  const auto bend = [&](double u) {
    return (rest_to_rest(u + h) - 2 * rest_to_rest(u) + rest_to_rest(u - h)) / (h * h);
  };
  for (const double end : {0.0, 1.0}) {
    EXPECT_NEAR(slope(end), 0, 1e-4);
    EXPECT_NEAR(bend(end), 0, 1e-3);
  }
  EXPECT_NEAR(slope(0.5), 15.0 / 8, 1e-5);
}

TEST(RestToRest, RisesAndIsTheSameFromBothEnds) {
  for (int i = 0; i < 1000; ++i) {
    const double u = i / 1000.0;
    ASSERT_LT(rest_to_rest(u), rest_to_rest(u + 1e-3));
    ASSERT_NEAR(rest_to_rest(u) + rest_to_rest(1 - u), 1, 1e-14);
  }
}

/// Samples on a straight line in joint space, at uneven fractions of the time.
struct Motion {
  std::vector<Configuration> samples;
  std::vector<double> fractions;
};
Motion joint_line(testing::Random& random, const Configuration& from, const Configuration& to) {
  Motion motion{{from}, {0}};
  while (motion.fractions.back() < 1) {
    const double u = std::min(1.0, motion.fractions.back() + random.uniform(0.002, 0.03));
    motion.fractions.push_back(u);
    motion.samples.push_back(u < 1 ? Configuration(from + rest_to_rest(u) * (to - from)) : to);
  }
  return motion;
}

Arm limited(const std::string& name) {
  const Arm plain = built_in(name);
  std::vector<Joint> joints = plain.joints();
  for (Joint& joint : joints) {
    joint.limits.velocity = std::min(joint.limits.velocity, 1.3);
    joint.limits.acceleration = std::min(joint.limits.acceleration, 4.0);
    joint.limits.jerk = std::min(joint.limits.jerk, 40.0);
  }
  return {name, joints, plain.tool(), plain.base()};
}

void expect_limits_kept(const Arm& arm, const Trajectory& trajectory) {
  const auto& [names, t, q, v, a] = trajectory;
  const double rounding = 1 + 1e-9;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double dt = t[k] - t[k - 1];
    ASSERT_GT(dt, 0);
    for (int i = 0; i < arm.dof(); ++i) {
      const Limits& limits = arm.limits()[static_cast<std::size_t>(i)];
      const double most = std::isfinite(limits.velocity) ? limits.velocity : velocity_when_unknown;
      ASSERT_LE(std::abs(q[k][i] - q[k - 1][i]) / dt, most * rounding) << arm.name();
      ASSERT_LE(std::abs(v[k][i]), most * rounding);
      ASSERT_LE(std::abs(a[k][i]), limits.acceleration * rounding);
      ASSERT_LE(std::abs(a[k][i] - a[k - 1][i]) / dt, limits.jerk * rounding + 1e-9);
    }
  }
}

TEST(AppendTimed, KeepsTheLimitsOfEveryBuiltInArmAndUsesOneOfThem) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    for (const Arm& arm : {built_in(name), limited(name)}) {
      for (int i = 0; i < 20; ++i) {
        const Motion motion =
            joint_line(random, random.configuration(arm), random.configuration(arm));
        Trajectory trajectory = at_rest(arm, motion.samples.front());
        append_timed(trajectory, arm, motion.samples, motion.fractions);
        ASSERT_NO_THROW(check_trajectory(trajectory));
        ASSERT_EQ(trajectory.positions, motion.samples);
        expect_limits_kept(arm, trajectory);

        Trajectory faster = trajectory;
        for (double& t : faster.times) t *= 0.99;
        for (Configuration& v : faster.velocities) v /= 0.99;
        for (Configuration& a : faster.accelerations) a /= 0.99 * 0.99;
        bool exceeded = false;
        for (std::size_t k = 1; k < faster.size(); ++k) {
          const double dt = faster.times[k] - faster.times[k - 1];
          for (int j = 0; j < arm.dof(); ++j) {
            const Limits& limits = arm.limits()[static_cast<std::size_t>(j)];
            const double most =
                std::isfinite(limits.velocity) ? limits.velocity : velocity_when_unknown;
            const auto& [names, t, q, v, a] = faster;
            exceeded |= std::abs(q[k][j] - q[k - 1][j]) / dt > most ||
                        std::abs(a[k][j]) > limits.acceleration ||
                        std::abs(a[k][j] - a[k - 1][j]) / dt > limits.jerk;
          }
        }
        ASSERT_TRUE(exceeded) << name << ": it could have been faster";
      }
    }
  }
}

TEST(AppendTimed, GivesTheDerivativesOfTheMotion) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 20; ++i) {
    const Configuration from = random.configuration(arm), way = random.configuration(arm) - from;
    Motion motion{{}, {}};
    const int steps = 400;
    for (int k = 0; k <= steps; ++k) {
      motion.fractions.push_back(double(k) / steps);
      motion.samples.push_back(from + rest_to_rest(motion.fractions.back()) * way);
    }
    Trajectory trajectory = at_rest(arm, from);
    append_timed(trajectory, arm, motion.samples, motion.fractions);
    const double duration = trajectory.times.back();
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      const double u = motion.fractions[k];
      const double slope = 30 * u * u * (1 - u) * (1 - u) / duration;
      const double bend = 60 * u * (1 - u) * (1 - 2 * u) / duration / duration;
      ASSERT_LT((trajectory.velocities[k] - slope * way).norm(), 1e-4 * way.norm() / duration);
      ASSERT_LT((trajectory.accelerations[k] - bend * way).norm(),
                1e-3 * way.norm() / duration / duration);
    }
    ASSERT_TRUE(trajectory.velocities.back().isZero(0));
    ASSERT_TRUE(trajectory.accelerations.back().isZero(0));
  }
}

TEST(AppendTimed, LastsAtLeastAsLongAsAsked) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  const Motion motion = joint_line(random, Configuration::Zero(3), Configuration::Ones(3));
  Trajectory quick = at_rest(arm, motion.samples.front()), slow = quick;
  append_timed(quick, arm, motion.samples, motion.fractions);
  append_timed(slow, arm, motion.samples, motion.fractions, 7);
  EXPECT_NEAR(quick.times.back(), 15.0 / 8, 0.01) << "1 rad at 1 rad/s at most";
  EXPECT_EQ(slow.times.back(), 7);
}

TEST(AppendTimed, ContinuesWhereTheTrajectoryEnds) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  Trajectory trajectory = at_rest(arm, random.configuration(arm));
  std::size_t samples = 1;
  for (int i = 0; i < 5; ++i) {
    const Motion motion =
        joint_line(random, trajectory.positions.back(), random.configuration(arm));
    append_timed(trajectory, arm, motion.samples, motion.fractions);
    samples += motion.samples.size() - 1;
  }
  EXPECT_EQ(trajectory.size(), samples);
  EXPECT_NO_THROW(check_trajectory(trajectory));
  expect_limits_kept(arm, trajectory);
}

TEST(AppendTimed, TakesJointsThatStandStillAndMotionsOfNothing) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm);
  for (const double way : {0.0, 1e-15, 1e-9, 1e-4}) {
    Configuration to = q;
    to[3] += way;
    const Motion motion = joint_line(random, q, to);
    Trajectory trajectory = at_rest(arm, q);
    append_timed(trajectory, arm, motion.samples, motion.fractions);
    ASSERT_NO_THROW(check_trajectory(trajectory)) << way;
    expect_limits_kept(arm, trajectory);
    ASSERT_GT(trajectory.times.back(), 0);
  }
  Trajectory one_step = at_rest(arm, q);
  append_timed(one_step, arm, std::vector<Configuration>{q, q}, std::vector<double>{0, 1});
  EXPECT_NO_THROW(check_trajectory(one_step));
}

TEST(AppendTimed, RefusesWhatIsNoMotion) {
  const Arm arm = built_in("rrr");
  const Configuration q = Configuration::Zero(3);
  const auto appended = [&](std::vector<Configuration> samples, std::vector<double> fractions,
                            double shortest = 0) {
    Trajectory trajectory = at_rest(arm, q);
    append_timed(trajectory, arm, samples, fractions, shortest);
  };
  EXPECT_REFUSED(appended({q}, {0}), "two samples");
  EXPECT_REFUSED(appended({q, q}, {0}), "fraction");
  EXPECT_REFUSED(appended({q, q, q}, {0, 0, 1}), "increase");
  EXPECT_REFUSED(appended({q, q}, {0, NAN}), "increase");
  EXPECT_REFUSED(appended({q, q}, {0, 0.5}), "from 0 to 1");
  EXPECT_REFUSED(appended({q, Configuration::Zero(2)}, {0, 1}), "3 joint values");
  EXPECT_REFUSED(appended({q, q}, {0, 1}, NAN), "shortest");
  Trajectory empty;
  EXPECT_REFUSED(
      append_timed(empty, arm, std::vector<Configuration>{q, q}, std::vector<double>{0, 1}),
      "trajectory");
}

}  // namespace
}  // namespace beeline
