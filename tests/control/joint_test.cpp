#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

#include <beeline/certificate/verify.h>
#include <beeline/control/joint.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/se2.h>

#include <tests/degrees.h>
#include <tests/random.h>
#include <tests/reason.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::deg;

TEST(ControlledMotion, IsPrintedWithItsErrorOrItsReason) {
  const auto printed = [](const ControlledMotion& motion) {
    std::ostringstream text;
    text << motion;
    return text.str();
  };
  const Arm arm = built_in("rrr");
  const Configuration start = Configuration::Zero(3), goal = Configuration::Constant(3, 0.5);
  const ControlledMotion motion = control_joints(arm, start, goal);
  const Trajectory& trajectory = motion.trajectory;
  EXPECT_EQ(printed(motion), "reached in " + number(trajectory.times.back()) + " s, " +
                                 std::to_string(trajectory.size()) + " samples, error " +
                                 number(motion.error));
  const ControlledMotion few = control_joints(arm, start, goal, {}, {.max_steps = 3});
  EXPECT_EQ(printed(few), "not_converged: " + sentence(few.reason));
  EXPECT_EQ(printed({}), "reached, error 0");
}

TEST(ControlJoints, ReducesTheErrorByTheGainInEveryStep) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 200; ++i) {
    const Configuration start = random.configuration(arm), goal = random.configuration(arm);
    const double kp = random.uniform(0.02, 1.9);
    const ControlledMotion motion = control_joints(arm, start, goal, {.kp = kp});
    ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
    ASSERT_NO_THROW(check_trajectory(motion.trajectory));
    ASSERT_EQ(motion.steps + 1, motion.trajectory.size());
    ASSERT_EQ(motion.arrivals, std::vector<std::size_t>{motion.trajectory.size() - 1});
    const Configuration way = goal - start;
    double left = 1;
    for (const Configuration& q : motion.trajectory.positions) {
      ASSERT_LT((goal - q - left * way).norm(), 1e-12);
      left *= 1 - kp;
    }
    ASSERT_LE(motion.error, 1e-6);
    ASSERT_EQ(motion.error, (goal - motion.trajectory.positions.back()).lpNorm<Eigen::Infinity>());
  }
}

TEST(ControlJoints, OvershootsByTheGainsExcessOverOne) {
  testing::Random random;
  std::vector<Joint> joints = built_in("ur5").joints();
  for (Joint& joint : joints) joint.limits.velocity = Limits::none;  // no step is scaled down
  const Arm arm("ur5", joints);
  for (int i = 0; i < 200; ++i) {
    const Configuration start = 0.2 * random.configuration(arm);
    const Configuration goal = 0.2 * random.configuration(arm);
    const double kp = random.uniform(0.05, 1.9);
    const ControlledMotion motion = control_joints(arm, start, goal, {.kp = kp});
    ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
    ASSERT_NEAR(motion.overshoot, std::max(0.0, kp - 1), 1e-12);
  }
  const Configuration goal = Configuration::Ones(6);
  EXPECT_EQ(control_joints(arm, Configuration::Zero(6), goal, {.kp = 1}).steps, 1);
}

TEST(ControlJoints, TakesMoreStepsWithASmallerGain) {
  const Arm arm = built_in("rrr");
  const Configuration goal{{1, -2, 3}};
  int fewer = 0;
  for (const double kp : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05, 0.01}) {
    const int steps = control_joints(arm, Configuration::Zero(3), goal, {.kp = kp}).steps;
    EXPECT_GT(steps, fewer) << kp;
    if (kp < 1) {
      EXPECT_EQ(steps, std::ceil(std::log(1e-6 / 3) / std::log(1 - kp))) << kp;
    }
    fewer = steps;
  }
}

TEST(ControlJoints, SaysThatTheGainIsTooLarge) {
  const Arm arm = built_in("rrr");
  for (const double kp : {2.0, 2.001, 2.5, 10.0, 1e300}) {
    const ControlledMotion motion =
        control_joints(arm, Configuration::Zero(3), Configuration{{1, 2, -1}}, {.kp = kp});
    EXPECT_EQ(motion.status, MotionStatus::not_converged) << kp;
    EXPECT_TRUE(motion.reason.code == ReasonCode::diverges ||
                testing::field<bool>(motion.reason, ReasonField::oscillates) == true)
        << kp << ": " << motion.reason;
    EXPECT_TRUE(motion.arrivals.empty());
    EXPECT_NO_THROW(check_trajectory(motion.trajectory));
    EXPECT_LT(motion.steps, 20'000);
  }
  // With limits, the oscillation that the gain causes reaches one of them.
  const Arm panda = built_in("panda");
  const Configuration middle = middle_configuration(panda);
  Configuration goal = middle;
  goal[1] += 1;
  const ControlledMotion motion =
      control_joints(panda, middle, goal, {.kp = 2.5}, {.time_step = 10});
  EXPECT_EQ(motion.status, MotionStatus::outside_limits);
  EXPECT_EQ(testing::joint(motion.reason), "joint2") << motion.reason;
  EXPECT_TRUE(motion.reason.has(ReasonField::overshoots)) << motion.reason;
  for (const Configuration& q : motion.trajectory.positions) {
    EXPECT_TRUE(limit_violations(panda, q).empty());
  }
}

TEST(ControlJoints, SaysThatTheGainIsTooSmall) {
  const Arm arm = built_in("rrr");
  for (const double kp : {1e-3, 1e-6, 1e-10}) {
    const ControlledMotion motion = control_joints(
        arm, Configuration::Zero(3), Configuration{{1, 2, -1}}, {.kp = kp}, {.max_steps = 3000});
    EXPECT_EQ(motion.status, MotionStatus::not_converged);
    EXPECT_EQ(motion.steps, 3000);
    EXPECT_EQ(testing::field<bool>(motion.reason, ReasonField::oscillates), false) << motion.reason;
    EXPECT_NEAR(motion.error, 2 * std::pow(1 - kp, 3000), 1e-9);
  }
}

TEST(ControlJoints, ConvergesWithAllThreeGains) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 100; ++i) {
    const PidGains gains{
        .kp = random.uniform(0.05, 0.6),
        .ki = i % 2 == 0 ? 0 : random.uniform(0.002, 0.02),  // kp / ki steps decide
        .kd = random.uniform(0, 0.3)};
    const Configuration goal = random.configuration(arm);
    const ControlledMotion motion = control_joints(arm, random.configuration(arm), goal, gains);
    ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
    ASSERT_LT((motion.trajectory.positions.back() - goal).lpNorm<Eigen::Infinity>(), 1e-6);
  }
}

TEST(ControlJoints, SumsAndDifferencesTheErrors) {
  const Arm arm("slide", {built_in("gantry").joints().front()});
  const PidGains gains{.kp = 0.3, .ki = 0.05, .kd = 0.2};
  const ControlledMotion motion =
      control_joints(arm, Configuration::Zero(1), Configuration::Ones(1), gains, {.max_steps = 50});
  double q = 0, sum = 0, before = 1;
  for (std::size_t k = 1; k < motion.trajectory.size(); ++k) {
    const double e = 1 - q;
    sum += e;
    q += gains.kp * e + gains.ki * sum + gains.kd * (e - before);
    before = e;
    ASSERT_NEAR(motion.trajectory.positions[k][0], q, 1e-14);
  }
  EXPECT_GT(motion.overshoot, 0.1) << "the sum has to be worked off";
}

TEST(ControlJoints, KeepsVelocityLimitsAndSaysThatItSlowedDown) {
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  Configuration goal = middle;
  goal.array() += 0.8;
  const SimulationOptions options{.time_step = 1e-3};
  const ControlledMotion motion = control_joints(arm, middle, goal, {.kp = 0.9}, options);
  ASSERT_EQ(motion.status, MotionStatus::reached) << motion.reason;
  EXPECT_GT(motion.slowed, 300);
  EXPECT_LT(motion.slowed, motion.steps);
  for (std::size_t k = 1; k < motion.trajectory.size(); ++k) {
    const Configuration step = motion.trajectory.positions[k] - motion.trajectory.positions[k - 1];
    for (int i = 0; i < 7; ++i) {
      const double most = arm.limits(i).velocity;
      ASSERT_LE(std::abs(step[i]) / options.time_step, most * (1 + 1e-9));
    }
  }
  EXPECT_NEAR(motion.trajectory.times.back(), motion.steps * options.time_step, 1e-12);
}

TEST(ControlJoints, ReportsAGoalOutsideTheLimits) {
  const Arm arm = built_in("panda");
  Configuration goal = middle_configuration(arm);
  goal[3] = 0.5;
  const ControlledMotion motion = control_joints(arm, middle_configuration(arm), goal);
  EXPECT_EQ(motion.status, MotionStatus::outside_limits);
  EXPECT_EQ(testing::joint(motion.reason), "joint4") << motion.reason;
  EXPECT_EQ(motion.steps, 0);
  EXPECT_EQ(motion.trajectory.size(), 1);
}

TEST(ControlJoints, StaysWhereTheGoalIsTheStart) {
  const Arm arm = built_in("rrr");
  const Configuration q{{1, 2, 3}};
  const ControlledMotion motion = control_joints(arm, q, q);
  EXPECT_EQ(motion.status, MotionStatus::reached);
  EXPECT_EQ(motion.steps, 0);
  EXPECT_EQ(motion.overshoot, 0);
}

// Figure 1.7: q_d = (99.2, -68.8, -30.4) degrees.
TEST(ControlJoints, MakesTheChaptersMotion) {
  const Arm arm = built_in("rrr");
  const Configuration start{{0, 90 * deg, 0}};
  const Configuration goal{{99.2 * deg, -68.8 * deg, -30.4 * deg}};
  const ControlledMotion motion = control_joints(arm, start, goal, {.kp = 0.1});
  ASSERT_EQ(motion.status, MotionStatus::reached);
  const Pose2 end = to_plane(forward_kinematics(arm, motion.trajectory.positions.back()));
  EXPECT_NEAR(end.x, 4.459, 5e-4);
  EXPECT_NEAR(end.y, 5.226, 5e-4);
  EXPECT_NEAR(end.theta, 0, 1e-5);
  // "The movement slows down considerably near the goal": each step is 0.9 of the one before it.
  const auto& q = motion.trajectory.positions;
  for (std::size_t k = 2; k < q.size(); ++k) {
    ASSERT_NEAR((q[k] - q[k - 1]).norm(), 0.9 * (q[k - 1] - q[k - 2]).norm(), 1e-12);
  }
}

TEST(ControlJoints, ReportsTheLimitsThatItUsesAndTheJumpAtTheStart) {
  const Arm arm = built_in("panda");
  const Configuration start = middle_configuration(arm);
  Configuration goal = start;
  goal[1] -= 0.2;
  goal[5] += 0.1;
  const ControlledMotion motion =
      control_joints(arm, start, goal, {.kp = 0.1}, {.time_step = 0.02});
  ASSERT_TRUE(motion) << motion.reason;
  EXPECT_EQ(motion.start_jump.joint, "joint2");
  EXPECT_NEAR(motion.start_jump.velocity, -1, 1e-9);
  EXPECT_NEAR(motion.start_jump.fraction, 1 / 2.175, 1e-9);
  EXPECT_FALSE(motion.start_jump.assumed);
  EXPECT_NEAR(motion.limits.velocity.fraction, 1 / 2.175, 1e-9);
  EXPECT_EQ(motion.limits.velocity.joint, "joint2");
  EXPECT_NEAR(motion.limits.acceleration.fraction, 5 / 7.5, 1e-6);
  const ControlledMotion planned = move_joints(arm, start, goal);
  ASSERT_TRUE(planned) << planned.reason;
  EXPECT_EQ(planned.start_jump.joint, "");
  EXPECT_EQ(planned.start_jump.fraction, 0);
  EXPECT_LE(planned.limits.acceleration.fraction, 1 + 1e-6);
  const ControlledMotion failed = control_joints(arm, start, goal, {}, {.max_steps = 3});
  EXPECT_EQ(failed.start_jump.joint, "");
  EXPECT_EQ(failed.limits.velocity.fraction, 0);
}

// The jump is the fault `moving` of verify(), whatever the gain and the step.
TEST(ControlJoints, ReportsAJumpWhereTheMotionDoesNotStartAtRest) {
  testing::Random random;
  int jumps = 0, rests = 0;
  for (int i = 0; i < testing::cases(100); ++i) {
    const Arm arm = built_in(i % 2 == 0 ? "rrr" : "panda");
    const Configuration start = middle_configuration(arm);
    Configuration goal = start;
    for (double& q : goal) q += random.uniform(-1, 1) * std::pow(10, random.uniform(-3, -0.3));
    const ControlledMotion motion =
        control_joints(arm, start, goal, {.kp = random.uniform(0.05, 0.9)},
                       {.time_step = std::pow(10, random.uniform(-2.5, -0.5))});
    ASSERT_TRUE(motion) << motion.reason;
    const std::vector<FaultsOfKind> faults =
        verify(arm, motion.trajectory, VerifyOptions{.moving = {.end = true}}).faults;
    const bool moves = std::any_of(faults.begin(), faults.end(), [](const FaultsOfKind& fault) {
      return fault.kind == Fault::moving;
    });
    EXPECT_EQ(!motion.start_jump.joint.empty(), moves) << i;
    ++(moves ? jumps : rests);
  }
  EXPECT_GT(jumps, testing::cases(100) / 20);
  EXPECT_GT(rests, testing::cases(100) / 20);
}

TEST(JointOvershoot, IsTheLargestDistanceBeyondTheGoalRelativeToTheDistanceToIt) {
  const auto at = [](double a, double b) { return Configuration{{a, b}}; };
  const std::vector<Configuration> samples{at(0, 1), at(1.2, 1), at(2.5, -1.1), at(2, -1)};
  EXPECT_NEAR(joint_overshoot(samples, at(2, -1)), 0.25, 1e-15);
  EXPECT_EQ(joint_overshoot(std::vector{at(0, 0), at(1, 0)}, at(1, 0)), 0);
}

TEST(ControlJoints, RefusesInvalidArguments) {
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm);
  const auto run = [&](PidGains gains, SimulationOptions options = {}) {
    return control_joints(arm, q, q, gains, options);
  };
  EXPECT_REFUSED(run({.kp = 0}), "kp");
  EXPECT_REFUSED(run({.kp = -1}), "kp");
  EXPECT_REFUSED(run({.kp = NAN}), "kp");
  EXPECT_REFUSED(run({.kp = INFINITY}), "kp");
  EXPECT_REFUSED(run({.ki = -1}), "ki");
  EXPECT_REFUSED(run({.kd = NAN}), "kd");
  EXPECT_REFUSED(run({}, {.tolerance = 0}), "tolerance");
  EXPECT_REFUSED(run({}, {.time_step = -1}), "time step");
  EXPECT_REFUSED(run({}, {.max_steps = 0}), "step");
  EXPECT_REFUSED(control_joints(arm, Configuration::Zero(7), q), "cannot start");
  EXPECT_REFUSED(control_joints(arm, q, Configuration::Zero(6)), "7 joint values");
  EXPECT_REFUSED(control_joints(arm, q, Configuration::Constant(7, NAN)), "finite");
}

}  // namespace
}  // namespace beeline
