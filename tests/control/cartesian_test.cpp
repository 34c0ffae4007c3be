#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/certificate/verify.h>
#include <beeline/control/cartesian.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

#include <tests/degrees.h>
#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;
using testing::deg;
constexpr auto by_jacobian = CartesianMethod::inverse_jacobian;
constexpr auto by_solutions = CartesianMethod::inverse_kinematics;

Pose planar(double x, double y, double theta) { return to_space({x, y, theta}); }

const Configuration rrr_start{{0, 90 * deg, 0}};
const std::vector<Pose> rrr_waypoints{planar(4.5, 5.2, 0), planar(2, 6, 0.5), planar(5, 2, -0.5)};

struct Case {
  Arm arm;
  Configuration start;
  std::vector<Pose> waypoints;
};

/// An arm, and waypoints around its start, of which the last is the start.
Case spatial_case(const std::string& name) {
  Case made{built_in(name), {}, {}};
  made.start = name == "panda" ? Configuration{{0, -0.785, 0, -2.356, 0, 1.571, 0.785}}
                               : Configuration{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(made.arm, made.start);
  made.waypoints = {make_pose(from.translation() + Vector3(0.1, 0.1, -0.1),
                              so3_exp({0.2, 0.3, -0.3}) * from.linear()),
                    make_pose(from.translation() + Vector3(0, -0.1, 0.1), from.linear()), from};
  return made;
}

void expect_arrived(const Case& given, const ControlledMotion& motion) {
  ASSERT_EQ(motion.status, MotionStatus::reached) << given.arm.name() << ": " << motion.reason;
  ASSERT_NO_THROW(check_trajectory(motion.trajectory));
  ASSERT_EQ(motion.steps + 1, motion.trajectory.size());
  ASSERT_EQ(motion.arrivals.size(), given.waypoints.size());
  ASSERT_TRUE(std::is_sorted(motion.arrivals.begin(), motion.arrivals.end()));
  ASSERT_EQ(motion.arrivals.back() + 1, motion.trajectory.size());
  for (std::size_t w = 0; w < given.waypoints.size(); ++w) {
    const Configuration& q = motion.trajectory.positions[motion.arrivals[w]];
    const Pose end = forward_kinematics(given.arm, q);
    ASSERT_LE(
        task_error(default_task(given.arm), given.waypoints[w], end).lpNorm<Eigen::Infinity>(),
        1e-6);
  }
  for (const auto& q : motion.trajectory.positions) {
    ASSERT_TRUE(limit_violations(given.arm, q).empty());
  }
  ASSERT_LE(motion.error, 1e-6);
}

double bend(const Case& given, const ControlledMotion& motion) {
  const auto& samples = motion.trajectory.positions;
  std::vector<Pose> poses{forward_kinematics(given.arm, samples.front())};
  poses.insert(poses.end(), given.waypoints.begin(), given.waypoints.end());
  const ToolPath path = lines_through(poses);
  const auto places =
      path_parameters_along(given.arm, samples, path, motion.arrivals, Task::position());
  return path_deviation(given.arm, motion.trajectory, places, path, Task::position())
      .sampled.position;
}

std::vector<Case> cases() {
  return {{built_in("rrr"), rrr_start, rrr_waypoints}, spatial_case("panda"), spatial_case("ur5")};
}

TEST(ControlInLines, ReachesEveryWaypointByBothMethods) {
  for (const Case& given : cases()) {
    for (const CartesianMethod method : {by_jacobian, by_solutions}) {
      const ControlledMotion motion =
          control_in_lines(given.arm, given.start, given.waypoints, {.method = method});
      expect_arrived(given, motion);
      EXPECT_EQ(motion.overshoot, 0) << name(method);
    }
  }
}

// Chapter 1.8: the inverse Jacobian makes straight lines; inverse kinematics needs intermediate
// poses.
TEST(ControlInLines, IsStraighterByTheJacobianThanByFewSolutions) {
  for (const Case& given : cases()) {
    const auto run = [&](CartesianOptions options) {
      return bend(given, control_in_lines(given.arm, given.start, given.waypoints, options));
    };
    const double straight = run({.method = by_jacobian, .gain = 0.05});
    EXPECT_LT(2 * straight, run({.method = by_solutions, .intermediate = 1})) << given.arm.name();
    EXPECT_LT(straight, run({.method = by_solutions, .intermediate = 2})) << given.arm.name();
  }
}

TEST(ControlInLines, IsStraighterWithMoreIntermediatePoses) {
  for (const Case& given : cases()) {
    double before = 1e9;
    for (const int intermediate : {1, 2, 5, 15, 40}) {
      const ControlledMotion motion =
          control_in_lines(given.arm, given.start, given.waypoints,
                           {.method = by_solutions, .gain = 0.3, .intermediate = intermediate});
      expect_arrived(given, motion);
      EXPECT_LT(bend(given, motion), before / 1.5) << intermediate;
      before = bend(given, motion);
    }
  }
}

TEST(ControlInLines, IsStraighterWithASmallerGain) {
  const Case given{built_in("rrr"), rrr_start, rrr_waypoints};
  double before = 1e9;
  int steps = 0;
  for (const double gain : {0.4, 0.2, 0.1, 0.05, 0.02}) {
    const ControlledMotion motion =
        control_in_lines(given.arm, given.start, given.waypoints, {.gain = gain});
    EXPECT_LT(bend(given, motion), before / 1.5) << gain;
    EXPECT_GT(motion.steps, steps);
    before = bend(given, motion);
    steps = motion.steps;
  }
}

// The error in the workspace decreases by the gain if J is constant during a step.
TEST(ControlInLines, ReducesTheErrorByTheGainInEveryStep) {
  const Arm gantry = built_in("gantry");
  const Configuration start{{0.3, -1}};
  Pose goal = forward_kinematics(gantry, start);
  goal.translation() += Vector3(2, 3, 0);
  const ControlledMotion motion = control_in_lines(gantry, start, std::vector{goal}, {.gain = 0.2});
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  double left = 3;
  for (const Configuration& q : motion.trajectory.positions) {
    const double error =
        task_error(Task::planar(), goal, forward_kinematics(gantry, q)).lpNorm<Eigen::Infinity>();
    ASSERT_NEAR(error, left, 1e-12);
    left *= 0.8;
  }
}

TEST(ControlInLines, OvershootsWithALargeGain) {
  const Case given{built_in("gantry"), Configuration::Zero(2), {}};
  Pose goal = forward_kinematics(given.arm, given.start);
  goal.translation() += Vector3(1, 2, 0);
  const auto overshoot = [&](double gain) {
    return control_in_lines(given.arm, given.start, std::vector{goal}, {.gain = gain}).overshoot;
  };
  EXPECT_NEAR(overshoot(1.5), 0.5, 1e-9);
  EXPECT_NEAR(overshoot(0.9), 0, 1e-9);
}

TEST(ControlInLines, RotatesByTheSmallerAngle) {
  const Arm arm = built_in("rrr");
  for (const CartesianMethod method : {by_jacobian, by_solutions}) {
    const double side = method == by_jacobian ? 1 : -1;
    const Pose from = planar(4, 3, -179 * deg * side), to = planar(4, 3, 179 * deg * side);
    const Configuration start = inverse_kinematics(arm, from).solutions.front();
    const ControlledMotion motion =
        control_in_lines(arm, start, std::vector{to}, {.method = method});
    ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
    const Configuration turned = motion.trajectory.positions.back() - start;
    EXPECT_NEAR(turned.sum(), -2 * deg * side, 1e-6) << name(method);
    for (const Configuration& q : motion.trajectory.positions) {
      ASSERT_LT((q - start).lpNorm<Eigen::Infinity>(), 0.2);
    }
  }
}

TEST(ControlInLines, SaysWhereAGoalIsOutOfReach) {
  for (const Case& given : cases()) {
    for (const CartesianMethod method : {by_jacobian, by_solutions}) {
      Pose far = given.waypoints.front();
      far.translation() *= 4 / (given.arm.planar() ? 1.5 : 1.0);
      const std::vector<Pose> waypoints{given.waypoints.front(), far};
      const ControlledMotion motion =
          control_in_lines(given.arm, given.start, waypoints, {.method = method});
      EXPECT_EQ(motion.status, MotionStatus::unreachable) << motion.reason;
      EXPECT_EQ(testing::field<std::size_t>(motion.reason, ReasonField::line), 2U) << motion.reason;
      EXPECT_EQ(motion.arrivals.size(), 1);
      EXPECT_LT(motion.steps, 20'000);
      EXPECT_GT(motion.error, 0.1);
      for (const Configuration& q : motion.trajectory.positions) {
        ASSERT_TRUE(q.allFinite());
        ASSERT_TRUE(limit_violations(given.arm, q).empty());
      }
    }
  }
}

TEST(ControlInLines, IsFiniteAtAndNearSingularities) {
  testing::Random random;
  const Arm rrr = built_in("rrr"), ur5 = built_in("ur5");
  for (int i = 0; i < 40; ++i) {
    const Arm& arm = i % 2 == 0 ? rrr : ur5;
    const double near = i < 4 ? 0 : std::pow(10, random.uniform(-12, -1));
    Configuration start = near * random.configuration(arm);
    if (i % 4 < 2) start[0] = random.uniform(-3, 3);
    Pose goal = forward_kinematics(arm, start);
    goal.translation() -= 0.3 * (goal.translation() - arm.base().translation()) +
                          Vector3(0.05, 0.02, arm.planar() ? 0 : 0.05);
    for (const CartesianMethod method : {by_jacobian, by_solutions}) {
      const ControlledMotion motion = control_in_lines(
          arm, start, std::vector{goal}, {.method = method, .simulation = {.max_steps = 5000}});
      for (std::size_t k = 1; k < motion.trajectory.size(); ++k) {
        const Configuration& q = motion.trajectory.positions[k];
        ASSERT_TRUE(q.allFinite());
        if (method == by_jacobian) {
          ASSERT_LE((q - motion.trajectory.positions[k - 1]).lpNorm<Eigen::Infinity>(), 1 + 1e-9);
        }
      }
      EXPECT_EQ(!motion.reason, motion.status == MotionStatus::reached);
    }
  }
}

TEST(ControlInLines, SaysThatItStopsAtASingularity) {
  const Arm arm = built_in("rrr");
  const std::vector<Pose> inwards{planar(5, 0, 0)};
  const ControlledMotion motion = control_in_lines(arm, Configuration::Zero(3), inwards);
  EXPECT_EQ(motion.status, MotionStatus::singular);
  EXPECT_TRUE(motion.reason.has(ReasonField::at_singularity)) << motion.reason;
  EXPECT_LT(motion.steps, 4000);
  EXPECT_EQ(control_in_lines(arm, Configuration::Zero(3), inwards, {.method = by_solutions}).status,
            MotionStatus::reached)
      << "inverse kinematics knows both elbows";
}

TEST(ControlInLines, NamesTheJointWhoseLimitStopsIt) {
  std::vector<Joint> joints = built_in("rrr").joints();
  joints[1].limits = {.lower = 0.5, .upper = 2.5};
  const Arm arm("limited", joints);
  for (const CartesianMethod method : {by_jacobian, by_solutions}) {
    const ControlledMotion motion = control_in_lines(
        arm, Configuration{{0, 1, 0}}, std::vector{planar(8.9, 0, 0)}, {.method = method});
    EXPECT_EQ(motion.status, MotionStatus::outside_limits) << motion.reason;
    EXPECT_EQ(testing::joint(motion.reason), "joint2") << motion.reason;
    for (const Configuration& q : motion.trajectory.positions) {
      ASSERT_TRUE(limit_violations(arm, q).empty());
    }
  }
}

TEST(ControlInLines, KeepsVelocityLimits) {
  const Case given = spatial_case("panda");
  const ControlledMotion motion = control_in_lines(
      given.arm, given.start, given.waypoints, {.gain = 0.9, .simulation = {.time_step = 0.002}});
  expect_arrived(given, motion);
  EXPECT_GT(motion.slowed, 100);
  for (std::size_t k = 1; k < motion.trajectory.size(); ++k) {
    const Configuration step = motion.trajectory.positions[k] - motion.trajectory.positions[k - 1];
    for (int i = 0; i < 7; ++i) {
      ASSERT_LE(std::abs(step[i]), 0.002 * given.arm.limits(i).velocity * (1 + 1e-9));
    }
  }
}

TEST(ControlInLines, SaysThatTheGainIsTooLarge) {
  const Arm arm = built_in("rrr");
  const ControlledMotion motion = control_in_lines(arm, rrr_start, rrr_waypoints, {.gain = 2.2});
  EXPECT_EQ(motion.status, MotionStatus::not_converged);
  EXPECT_EQ(testing::field<bool>(motion.reason, ReasonField::oscillates)
                .value_or(motion.reason.code == ReasonCode::diverges),
            true)
      << motion.reason;
}

TEST(ControlInLines, MovesByPositionAlone) {
  const Case given = spatial_case("ur5");
  for (const CartesianMethod method : {by_jacobian, by_solutions}) {
    const ControlledMotion motion = control_in_lines(given.arm, given.start, given.waypoints,
                                                     {.method = method, .task = Task::position()});
    ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
    const Pose end = forward_kinematics(given.arm, motion.trajectory.positions.back());
    EXPECT_LT((end.translation() - given.waypoints.back().translation()).norm(), 2e-6);
  }
}

TEST(ControlInLines, RefusesInvalidArguments) {
  const Arm arm = built_in("rrr");
  const auto run = [&](std::vector<Pose> waypoints, CartesianOptions options = {}) {
    return control_in_lines(arm, rrr_start, waypoints, options);
  };
  Pose nan = rrr_waypoints[0];
  nan.translation().y() = NAN;
  EXPECT_REFUSED(run({}), "waypoint");
  EXPECT_REFUSED(run({rrr_waypoints[0], nan}), "waypoint 2");
  for (const float bad : {0.F, NAN}) EXPECT_REFUSED(run(rrr_waypoints, {.gain = bad}), "gain");
  EXPECT_REFUSED(run(rrr_waypoints, {.intermediate = 0}), "intermediate");
  EXPECT_REFUSED(run(rrr_waypoints, {.simulation = {.tolerance = -1}}), "tolerance");
  EXPECT_REFUSED(control_in_lines(arm, Configuration::Zero(2), rrr_waypoints), "3 joint values");
}

}  // namespace
}  // namespace beeline
