#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>

#include <beeline/certificate/verify.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/retime.h>

#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>
#include <tests/timing/random_section.h>
#include <tests/timing/random_waypoints.h>

namespace beeline {
namespace {

using testing::random_waypoints;

/// Distance of q from the line between a and b.
double distance_from(const Configuration& q, const Configuration& a, const Configuration& b) {
  const double fraction = std::clamp((q - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + fraction * (b - a) - q).norm();
}

TEST(MoveThrough, PassesConfigurationsInBlends) {
  testing::Random random;
  const Arm arm = built_in("panda");
  for (int i = 0; i < 10; ++i) {
    const std::vector<Configuration> waypoints =
        random_waypoints(random, arm, random.integer(3, 12)).positions;
    const Profile profile = testing::profile_of_case(i);
    const Retimed stopping = move_through(arm, waypoints, {.profile = profile, .joint_blend = 0});
    ASSERT_FALSE(stopping.reason) << stopping.reason;
    ASSERT_EQ(stopping.sections, waypoints.size() - 1);
    const double most = random.uniform(0.1, 0.5);
    const Retimed blended = move_through(arm, waypoints, {.profile = profile, .joint_blend = most});
    ASSERT_FALSE(blended.reason) << blended.reason;
    ASSERT_EQ(blended.blends.size(), waypoints.size() - 2);
    // The other profiles have one shape for the whole path, and its curves slow all of it down.
    const bool follows_curves = profile == Profile::fastest || profile == Profile::jerk;
    if (follows_curves) {
      EXPECT_LE(blended.duration(), stopping.duration());
    }
    EXPECT_LE(blended.limits.velocity.fraction, 1 + 1e-9);
    EXPECT_LE(blended.limits.acceleration.fraction, 1 + 1e-9);
    double passing = 0;
    for (std::size_t k = 1; k + 1 < waypoints.size(); ++k) {
      const double radius = blended.blends[k - 1];
      ASSERT_GE(radius, 0);
      ASSERT_LE(radius, most);
      passing += radius > 0;
      double nearest = 1e9;
      for (const Configuration& q : blended.trajectory.positions) {
        nearest = std::min(nearest, (q - waypoints[k]).norm());
      }
      EXPECT_LE(nearest, radius + 1e-8) << k;
    }
    EXPECT_GT(passing, 0);
    EXPECT_EQ(blended.sections, waypoints.size() - 1 - static_cast<std::size_t>(passing));
    // Off the lines it is in a blend, whose triangle is at most half its radius high.
    for (const Configuration& q : blended.trajectory.positions) {
      double nearest = 1e9;
      for (std::size_t k = 1; k < waypoints.size(); ++k) {
        nearest = std::min(nearest, distance_from(q, waypoints[k - 1], waypoints[k]));
      }
      EXPECT_LE(nearest, most / 2 + 1e-8);
    }
  }
}

TEST(MoveThrough, StopsWhereItTurnsBack) {
  const Arm arm = built_in("rrr");
  const Configuration a = Eigen::Vector3d(0, 0.5, 0), b = Eigen::Vector3d(1, 0.5, 0);
  const Retimed there_and_back = move_through(arm, std::vector{a, b, a}, {.joint_blend = 0.1});
  ASSERT_FALSE(there_and_back.reason) << there_and_back.reason;
  EXPECT_EQ(there_and_back.blends, std::vector<double>{0});
  EXPECT_EQ(there_and_back.sections, 2u);
  const auto& positions = there_and_back.trajectory.positions;
  EXPECT_NE(std::find(positions.begin(), positions.end(), b), positions.end());
}

TEST(MoveThrough, StopsAtRepeatedConfigurationsAndAtTinyBlends) {
  const Arm arm = built_in("rrr");
  const Configuration a = Eigen::Vector3d(0, 0.5, 0), b = Eigen::Vector3d(1, 0.5, 0),
                      c = Eigen::Vector3d(1, 1, 0.5), d = Eigen::Vector3d(0, 1, 0.7);
  const std::vector<Configuration> waypoints{a, b, b, c, d};
  const Retimed moving = move_through(arm, waypoints, {.joint_blend = 0.2});
  ASSERT_FALSE(moving.reason) << moving.reason;
  EXPECT_EQ(moving.blends, (std::vector<double>{0, 0.2}));
  EXPECT_EQ(moving.sections, 2u);
  const Retimed stopping = move_through(arm, waypoints, {.joint_blend = 0});
  for (const double tiny : {1e-300, 1e-12, 1e-6, 1e-4}) {
    EXPECT_EQ(move_through(arm, waypoints, {.joint_blend = tiny}).duration(), stopping.duration());
  }
  const Retimed small = move_through(arm, waypoints, {.joint_blend = 2e-3});
  EXPECT_LE(small.duration(), stopping.duration());
}

TEST(MoveThrough, ManyBlendsTakeNearlyTheTimeOfFew) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  std::vector<Configuration> waypoints;
  for (int i = 0; i < 200; ++i) {
    waypoints.push_back(middle + 0.5 * (random.configuration(arm) - middle));
  }
  double in_parts = 0;  // of ten waypoints, with a stop between them
  for (std::size_t k = 0; k + 1 < waypoints.size(); k += 9) {
    const std::size_t count = std::min<std::size_t>(10, waypoints.size() - k);
    in_parts +=
        move_through(arm, std::span(waypoints).subspan(k, count), {.joint_blend = 0.1}).duration();
  }
  const Retimed whole = move_through(arm, waypoints, {.joint_blend = 0.1});
  ASSERT_FALSE(whole.reason) << whole.reason;
  EXPECT_LT(whole.duration(), 1.08 * in_parts);
}

TEST(MoveThrough, WithoutBlendsFollowsTheSplineOfRetime) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Trajectory given = random_waypoints(random, arm, 6);
  const Retimed through = move_through(arm, given.positions);
  const Retimed expected = retime(arm, given, {.no_unwrap = true});
  EXPECT_EQ(through.trajectory.positions, expected.trajectory.positions);
  EXPECT_EQ(through.trajectory.times, expected.trajectory.times);
  EXPECT_TRUE(through.blends.empty());
}

// A spline through configurations on a limit may leave it between the grid points of its path.
TEST(MoveThrough, StaysWithinPositionLimitsOrIsRefused) {
  testing::Random random;
  const Arm arm = built_in("panda");
  int found = 0, refused = 0;
  for (int i = 0; i < testing::cases(100); ++i) {
    std::vector<Configuration> waypoints = random_waypoints(random, arm, 3).positions;
    for (int k = 0; k < arm.dof(); ++k) {
      if (random.uniform(0, 1) < 0.4) waypoints[0][k] = arm.limits(k).upper;
    }
    waypoints[1] = waypoints[0];
    waypoints[1][random.integer(0, arm.dof() - 1)] -= 1e-4;
    const Retimed motion = move_through(arm, waypoints);
    found += motion ? 1 : 0;
    refused += motion.reason.code == ReasonCode::spline_outside_limits ? 1 : 0;
    ASSERT_EQ(motion.trajectory.size() > 0, static_cast<bool>(motion));
    if (!motion) continue;
    const Verification verified = verify(arm, motion.trajectory);
    ASSERT_TRUE(verified) << verified.reason;
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(refused, 0);
}

// The overshoot of a spline over a limit is no angle in degrees, though it may look like one.
TEST(MoveThrough, DoesNotTakeItsOwnOvershootForDegrees) {
  testing::Random random;
  int refused = 0;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < testing::cases(100); ++i) {
    const Configuration q = random.configuration(arm);
    std::vector<Configuration> waypoints{q, q, random.configuration(arm)};
    waypoints[1][0] = waypoints[0][0] = arm.limits(0).upper;
    waypoints[1][1] += 1e-4;
    const Retimed motion = move_through(arm, waypoints);
    if (motion.reason.code != ReasonCode::spline_outside_limits) continue;
    ++refused;
    EXPECT_FALSE(motion.reason.has(ReasonField::in_degrees));
    // What the sentence advises.
    EXPECT_TRUE(move_through(arm, waypoints, {.joint_blend = 0.1}));
  }
  EXPECT_GT(refused, 0);
}

// At a stop the velocity of linear joints changes within the shorter of two intervals.
TEST(MoveThrough, PassesStopsBetweenShortAndLongSectionsLinearly) {
  testing::Random random;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "panda" : "ur5");
    const std::vector<Configuration> q = random_waypoints(random, arm, 2).positions;
    const Configuration step = (q[1] - q[0]).normalized() * std::pow(10, random.uniform(-8, -3));
    const std::vector<Configuration> waypoints{q[0], q[0] + step, q[0] + step,
                                               q[1], q[1],        q[1] - step};
    const Retimed motion = move_through(arm, waypoints, {.interpolation = Interpolation::linear});
    ASSERT_TRUE(motion) << motion.reason;
    const Verification verified = verify(arm, motion.trajectory);
    EXPECT_TRUE(verified) << arm.name() << " " << step.norm() << ": " << verified.reason;
  }
}

// Where two sections meet at a stop, a joint may brake in one and start in the other: the jump of
// its acceleration is larger than at the ends of each.
TEST(MoveThrough, KeepsKnownJerkAtStops) {
  testing::Random random;
  const int count = testing::cases(60);
  for (int i = 0; i < count; ++i) {
    std::map<std::string, LimitOverrides> limits;
    const Arm named = built_in(i % 2 == 0 ? "rrr" : "ur5e");
    const double velocity = random.uniform(0.1, 1), acceleration = random.uniform(1, 20);
    for (const std::string& joint : named.joint_names()) {
      limits[joint] = {.velocity = velocity,
                       .acceleration = acceleration,
                       .jerk = acceleration * random.uniform(0.3, 3)};
    }
    const Arm arm = with_limits(named, limits);
    const Interpolation interpolation = i % 3 == 0 ? Interpolation::linear : Interpolation::cubic;
    const Retimed motion =
        move_through(arm, random_waypoints(random, arm, random.integer(3, 6)).positions,
                     {.profile = Profile::trapezoidal,
                      .interpolation = interpolation,
                      .joint_blend = 0,
                      .rate = i % 5 == 0 ? 100.0 : 0});
    ASSERT_FALSE(motion.reason) << motion.reason;
    EXPECT_LE(motion.limits.jerk.fraction, 1 + 1e-5) << "case " << i << ", " << named.name();
    const Verification proof = verify(arm, motion.trajectory);
    EXPECT_TRUE(proof) << "case " << i << ": " << proof.reason;
  }
}

// Otherwise a player that takes joint values for angles may turn the joint the other way.
TEST(MoveThrough, TurnsNoJointByHalfARevolutionBetweenSamples) {
  testing::Random random;
  const Arm arm = built_in("ur5e");
  const int count = testing::cases(40);
  int passed = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<Configuration> waypoints{Configuration::Zero(6)};
    for (int k = 0; k < 8; ++k) {
      const double size = k % 3 == 2 ? 0.05 : 3;  // short legs between long ones
      waypoints.push_back(Configuration(6));
      for (double& q : waypoints.back()) q = random.uniform(-size, size);
      if (k % 3 == 2) waypoints.back() += waypoints[waypoints.size() - 2];
    }
    const Retimed motion = move_through(arm, waypoints, {.profile = testing::profile_of_case(i)});
    if (motion.reason) continue;  // the spline leaves the limits
    ++passed;
    for (std::size_t k = 1; k < motion.trajectory.size(); ++k) {
      const Configuration change =
          motion.trajectory.positions[k] - motion.trajectory.positions[k - 1];
      ASSERT_LT(change.cwiseAbs().maxCoeff(), 3.01) << "case " << i << ", sample " << k;
    }
  }
  EXPECT_GE(2 * passed, count);
}

// Of a path whose later section is refused no motion is left.
TEST(MoveThrough, OfARefusedPathLeavesNothing) {
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm), step = Configuration::Constant(7, 0.1);
  Configuration on_limit = q + 2 * step, next = q + step;
  on_limit[6] = arm.limits(6).upper;
  next[6] = arm.limits(6).upper - 1e-3;
  const Retimed motion =
      move_through(arm, std::vector<Configuration>{q, q + step, q + step, on_limit, next, q});
  ASSERT_FALSE(motion);
  EXPECT_EQ(motion.trajectory.size(), 0U);
}

TEST(MoveThrough, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("rrr");
  const Configuration a = Eigen::Vector3d(0, 0.5, 0), b = Eigen::Vector3d(1, 0.5, 0);
  EXPECT_REFUSED(move_through(arm, std::vector{a, b}, {.joint_blend = -1}), "joint_blend");
  EXPECT_REFUSED(move_through(arm, std::vector{a}), "one sample");
  EXPECT_REFUSED(move_through(arm, {}), "no samples");
  EXPECT_REFUSED(move_through(arm, std::vector{a, Configuration(Configuration::Zero(2))}),
                 "takes 3 joint values");
}

}  // namespace
}  // namespace beeline
