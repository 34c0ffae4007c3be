#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/retime.h>

#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>
#include <tests/timing/random_section.h>
#include <tests/timing/random_waypoints.h>

namespace beeline {
namespace {

using testing::profiles;
using testing::random_waypoints;

TEST(Retime, KeepsEverySampleAndItsLimitsWithEveryProfile) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 5; ++i) {
    const Trajectory given = random_waypoints(random, arm, random.integer(2, 8));
    for (const Profile profile : profiles) {
      const Retimed timed = retime(arm, given, {.profile = profile});
      ASSERT_FALSE(timed.reason) << name(profile);
      ASSERT_NO_THROW(check_trajectory(timed.trajectory));
      ASSERT_LE(timed.limits.velocity.fraction, 1 + 1e-9);
      ASSERT_LE(timed.limits.acceleration.fraction, 1 + 1e-9);
      if (profile != Profile::fastest && profile != Profile::trapezoidal) {
        ASSERT_LE(timed.limits.jerk.fraction, 1 + 1e-9);
      }
      ASSERT_EQ(timed.sections, 1u);
      std::size_t kept = 0;
      for (const Configuration& q : timed.trajectory.positions) {
        if (kept < given.size() && (q - given.positions[kept]).norm() < 1e-8) ++kept;
      }
      ASSERT_EQ(kept, given.size()) << name(profile);
      for (const auto* v :
           {&timed.trajectory.velocities.front(), &timed.trajectory.velocities.back()}) {
        ASSERT_EQ(v->norm(), 0);
      }
    }
  }
}

TEST(Retime, TellsVelocitiesAndAccelerationsThatFitThePositions) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (const Profile profile : profiles) {
    const Retimed timed =
        retime(arm, random_waypoints(random, arm, 5), {.profile = profile, .rate = 2000});
    const auto& [names, t, q, v, a] = timed.trajectory;
    for (std::size_t k = 0; k + 2 < t.size(); ++k) {
      const double h = t[k + 1] - t[k];
      ASSERT_NEAR(h, 1.0 / 2000, 1e-9);
      ASSERT_LT(((q[k + 1] - q[k]) / h - 0.5 * (v[k] + v[k + 1])).norm(), 5e-3) << name(profile);
      const bool jumps = profile == Profile::fastest || profile == Profile::trapezoidal;
      if (jumps) continue;
      ASSERT_LT(((v[k + 1] - v[k]) / h - 0.5 * (a[k] + a[k + 1])).norm(), 2) << name(profile);
    }
  }
}

TEST(Retime, AtARateKeepsBothEndsAndTheDuration) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 20; ++i) {
    const Trajectory given = random_waypoints(random, arm, 4);
    const Retimed whole = retime(arm, given), sampled = retime(arm, given, {.rate = 50});
    ASSERT_TRUE(sampled);
    EXPECT_EQ(sampled.trajectory.positions.front(), given.positions.front());
    EXPECT_EQ(sampled.trajectory.positions.back(), given.positions.back());
    const double longer = sampled.trajectory.times.back() - whole.trajectory.times.back();
    EXPECT_GT(longer, -0.02 * whole.trajectory.times.back());
    EXPECT_LT(longer, 2 / 50. + 0.02 * whole.trajectory.times.back());
    for (std::size_t k = 0; k + 1 < sampled.trajectory.size(); ++k) {
      ASSERT_NEAR(sampled.trajectory.times[k], double(k) / 50, 1e-12);
    }
    ASSERT_NEAR(sampled.trajectory.times.back(), double(sampled.trajectory.size() - 1) / 50, 1e-12);
  }
}

TEST(Retime, ScalesItsDurationWithTheSpeedScale) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory given = random_waypoints(random, arm, 5);
  for (const Profile profile : profiles) {
    const double full = retime(arm, given, {.profile = profile}).trajectory.times.back();
    const double half =
        retime(arm, given, {.profile = profile, .speed_scale = 0.5}).trajectory.times.back();
    EXPECT_NEAR(half, 2 * full, 1e-2 * full) << name(profile);
  }
}

TEST(Retime, KeepsTheToolsSpeed) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (const Profile profile : profiles) {
    const Trajectory given = random_waypoints(random, arm, 5);
    const Retimed timed = retime(arm, given, {.profile = profile, .tool_speed = 0.2});
    ASSERT_TRUE(timed);
    EXPECT_LE(timed.tool_speed, 0.2 * (1 + 1e-9));
    EXPECT_GT(timed.tool_speed, 0.17) << name(profile);
    double length = 0;
    const auto& t = timed.trajectory.times;
    const auto& q = timed.trajectory.positions;
    for (std::size_t k = 1; k < t.size(); ++k) {
      const double way_of_step = (forward_kinematics(arm, q[k]).translation() -
                                  forward_kinematics(arm, q[k - 1]).translation())
                                     .norm();
      ASSERT_LE(way_of_step, 0.2 * (t[k] - t[k - 1]) * (1 + 1e-3) + 1e-12);
      length += way_of_step;
    }
    ASSERT_GE(t.back(), length / 0.2);
  }
}

TEST(Retime, StandsStillWhereTheRecordingDid) {
  const Arm arm = built_in("gantry");
  const auto at = [](double x, double y) { return Configuration(Eigen::Vector2d(x, y)); };
  // Round a corner: without a stop the spline would swing out of it.
  Trajectory corner{arm.joint_names(), {}, {}, {}, {}};
  for (const auto& q : {at(0, 0), at(0.5, 0), at(1, 0), at(1, 0), at(1, 0.5), at(1, 1)}) {
    corner.times.push_back(double(corner.size()));
    corner.positions.push_back(q);
  }
  const auto expect_square = [&](const Retimed& timed) {
    ASSERT_FALSE(timed.reason);
    ASSERT_EQ(timed.sections, 2u);
    const auto& [names, t, q, v, a] = timed.trajectory;
    int still = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      ASSERT_LT(std::min(std::abs(q[k][1]), std::abs(q[k][0] - 1)), 1e-12);
      if (v[k].norm() == 0) ++still;
    }
    ASSERT_EQ(still, 3);
  };
  expect_square(retime(arm, corner));
  corner.times.erase(corner.times.begin() + 3);
  corner.positions.erase(corner.positions.begin() + 3);
  for (const double speed : {0., 1., 0., 1., 0.}) corner.velocities.push_back(at(speed, speed));
  expect_square(retime(arm, corner));
}

TEST(Retime, OfWhatItHasTimedTakesAsLong) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (const Profile profile : {Profile::fastest, Profile::jerk}) {
    const Trajectory once =
        retime(arm, random_waypoints(random, arm, 4), {.profile = profile}).trajectory;
    const Trajectory twice = retime(arm, once, {.profile = profile}).trajectory;
    EXPECT_NEAR(twice.times.back(), once.times.back(), 0.05 * once.times.back()) << name(profile);
  }
}

// Slowed down, other samples than before are the worst.
TEST(Retime, AtARateKeepsTheLimitsOnATightCorner) {
  const Arm arm = built_in("panda");
  const Eigen::Vector2d begin(0, 0), corner(0.4, 0), end(0.4, 0.4);
  for (const double size : {1e-3, 1e-4}) {
    Trajectory given{arm.joint_names(), {}, {}, {}, {}};
    const auto add = [&](const Eigen::Vector2d& q) {
      given.times.push_back(double(given.size()));
      given.positions.push_back(middle_configuration(arm));
      given.positions.back().head<2>() += q;
    };
    for (int k = 0; k < 20; ++k) add(begin + k / 20. * (corner - Eigen::Vector2d(size, 0) - begin));
    for (double u = 0; u <= 1; u += 0.125) {  // a parabola
      add(corner + size * Eigen::Vector2d(-(1 - u) * (1 - u), u * u));
    }
    for (int k = 19; k >= 0; --k) add(end + k / 20. * (corner + Eigen::Vector2d(0, size) - end));
    for (const Profile profile : profiles) {
      const double duration = retime(arm, given, {.profile = profile}).trajectory.times.back();
      for (const double rate : {10., 97., 1000.}) {
        const Retimed timed = retime(arm, given, {.profile = profile, .rate = rate});
        ASSERT_FALSE(timed.reason);
        EXPECT_LE(timed.limits.velocity.fraction, 1 + 1e-9);
        EXPECT_LE(timed.limits.acceleration.fraction, 1 + 1e-9);
        EXPECT_LE(keeps_jerk(profile) ? timed.limits.jerk.fraction : 0, 1 + 1e-9);
        // Few samples cannot follow the corner: what is lost there is lost by the whole motion.
        EXPECT_LT(timed.trajectory.times.back(), duration * (rate < 1000 ? 2.2 : 1.25) + 2 / rate)
            << name(profile) << ' ' << rate;
      }
    }
  }
}

TEST(Retime, ReturnsAReasonWhereThePathLeavesThePositionLimits) {
  const Arm arm = built_in("panda");
  Trajectory given = random_waypoints(*std::make_unique<testing::Random>(), arm, 3);
  given.positions[1][3] = 0.5;
  const Retimed timed = retime(arm, given);
  EXPECT_FALSE(timed);
  EXPECT_EQ(testing::joint(timed.reason), "joint4") << timed.reason;
  EXPECT_EQ(timed.trajectory.size(), 0u);
}

TEST(Retime, AcceptsTheSmallestSpeeds) {
  testing::Random random;
  for (const char* name : {"panda", "ur5", "scara", "rrr"}) {
    const Arm arm = built_in(name);
    Trajectory given{arm.joint_names(), {0, 1, 2}, {}, {}, {}};
    const Configuration middle = middle_configuration(arm);
    for (int k = 0; k < 3; ++k) {
      given.positions.push_back(middle + 0.2 * (random.configuration(arm) - middle));
    }
    for (const Profile profile : profiles) {
      const Retimed slow = retime(arm, given, {.profile = profile, .speed_scale = 1e-6});
      ASSERT_TRUE(slow) << slow.reason;
      EXPECT_LE(slow.limits.velocity.fraction, 1e-6 * (1 + 1e-6));
      const Retimed creeping = retime(arm, given, {.profile = profile, .tool_speed = 1e-8});
      ASSERT_TRUE(creeping) << creeping.reason;
      EXPECT_LE(creeping.tool_speed, 1e-8 * (1 + 1e-6));
    }
  }
}

TEST(Retime, LengthensASectionToAPeriod) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Trajectory given{
      arm.joint_names(), {0, 1}, {random.configuration(arm), random.configuration(arm)}, {}, {}};
  const double rate = 0.9 / retime(arm, given).trajectory.times.back();
  const Retimed timed = retime(arm, given, {.rate = rate});
  EXPECT_NEAR(timed.trajectory.times.back() * rate,
              std::round(timed.trajectory.times.back() * rate), 1e-6);
  const Retimed many = retime(arm, given, {.rate = 1e7});
  EXPECT_FALSE(many);
  EXPECT_TRUE(many.reason.has(ReasonField::possible_rate)) << many.reason;
}

/// The recording with each position twice, which is a stop.
Trajectory with_stops(const Trajectory& given) {
  Trajectory stopping{given.joint_names, {}, {}, {}, {}};
  for (std::size_t k = 0; k < given.size(); ++k) {
    for (int twice = 0; twice < 2; ++twice) {
      stopping.times.push_back(2 * given.times[k] + twice);
      stopping.positions.push_back(given.positions[k]);
    }
  }
  return stopping;
}

TEST(Retime, ReportsARateThatIsPossibleForTheWholeMotion) {
  testing::Random random;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "ur5" : "panda");
    const Trajectory given = with_stops(random_waypoints(random, arm, random.integer(2, 6)));
    RetimeOptions options{.rate = random.uniform(100, 2000)};
    options.max_samples = random.integer(40, 90);
    const Retimed dense = retime(arm, given, options);
    ASSERT_EQ(dense.reason.code, ReasonCode::too_many_samples_at_rate);
    EXPECT_EQ(testing::field<std::size_t>(dense.reason, ReasonField::max_samples),
              static_cast<std::size_t>(options.max_samples));
    // The samples up to this time are too many.
    const auto time = testing::field<double>(dense.reason, ReasonField::duration);
    ASSERT_TRUE(time);
    EXPECT_GE(*time * options.rate + 1, options.max_samples);
    const auto possible = testing::field<double>(dense.reason, ReasonField::possible_rate);
    ASSERT_TRUE(possible) << dense.reason;
    options.rate = *possible;
    const Retimed sparse = retime(arm, given, options);
    EXPECT_TRUE(sparse) << dense.reason << "; " << sparse.reason;
    EXPECT_LE(sparse.trajectory.size(), static_cast<std::size_t>(options.max_samples));
    EXPECT_GT(4 * sparse.trajectory.size(), static_cast<std::size_t>(options.max_samples));
  }
}

TEST(Retime, RefusesOptionsOutOfRange) {
  const Arm arm = built_in("ur5");
  const Configuration zero = Configuration::Zero(6);
  const Trajectory still{arm.joint_names(), {0, 1}, {zero, zero}, {}, {}};
  const Trajectory given{arm.joint_names(), {0, 1}, {zero, zero + Configuration::Ones(6)}, {}, {}};
  EXPECT_REFUSED(retime(arm, still), "two different positions");
  EXPECT_REFUSED(retime(arm, {arm.joint_names(), {}, {}, {}, {}}), "no samples");
  for (const double scale : {1.5, 0.0, 1e-7, 1e-300, std::nan("")}) {
    EXPECT_REFUSED(retime(arm, given, {.speed_scale = scale}), "from 1e-06 to 1");
  }
  for (const double speed : {0.0, -1.0, 1e-10, 1e-300, std::nan("")}) {
    EXPECT_REFUSED(retime(arm, still, {.tool_speed = speed}), "1e-08 m/s at least");
  }
  EXPECT_REFUSED(retime(arm, still, {.rate = -1}), "or above");
  EXPECT_REFUSED(profile_named("scurve"), "s-curve");
  for (const Profile profile : profiles) EXPECT_EQ(profile_named(name(profile)), profile);
}

}  // namespace
}  // namespace beeline
