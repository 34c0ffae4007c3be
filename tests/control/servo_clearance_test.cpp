#include <gtest/gtest.h>
#include <sstream>

#include <beeline/control/servo.h>

#include <tests/allocations.h>
#include <tests/control/servo_cell.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::distance_rounding;
using testing::excess_at;
using testing::loop_arm;
using testing::loop_model;
using testing::loop_scene;
using testing::loop_step;
using testing::LoopLimits;

/// A servo that keeps the clearances of a cell, and what it has to keep.
struct Cell {
  Cell(const std::string& name, const std::string& cell, LoopLimits limits)
      : arm(loop_arm(name, limits)), model(loop_model(arm, name, loop_scene(cell))) {}

  /// The configuration half-way through a step, too, and the limits.
  void expect_kept(const Configuration& q, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& before) const {
    ASSERT_GE(excess_at(model, q + loop_step / 2 * v), -distance_rounding)
        << nearest_pair(model, q).names[1];
    ASSERT_GE(excess_at(model, q + loop_step * v), -distance_rounding)
        << nearest_pair(model, q).names[1];
    ASSERT_TRUE(limit_violations(arm, q + loop_step * v).empty());
    for (int k = 0; k < arm.dof(); ++k) {
      ASSERT_LE(std::abs(v[k]), arm.limits(k).velocity + distance_rounding);
      ASSERT_LE(std::abs(v[k] - before[k]),
                arm.limits(k).acceleration * loop_step + distance_rounding);
    }
  }

  Arm arm;
  CollisionModel model;
};

Twist random_twist(testing::Random& random) {
  Twist twist;
  twist << random.vector(0.6), random.vector(1.5);
  return twist;
}

Vector3 towards_base(const Arm& arm, const Configuration& q) {
  return -forward_kinematics(arm, q).translation().normalized();
}

/// Random commands, each for so long that the arm arrives at the bodies. Checks the clearances by
/// the distances of the model, which know nothing of the loop.
void expect_clearance_for_random_commands(const std::string& name, const std::string& cell_name,
                                          LoopLimits limits) {
  testing::Random random;
  const Cell cell(name, cell_name, limits);
  Eigen::VectorXd v(cell.arm.dof()), before(cell.arm.dof());
  int held = 0;
  for (int run = 0; run < testing::cases(18); ++run) {
    Servo servo(cell.arm, {.model = &cell.model});
    Configuration q = testing::clear_configuration(random, cell.arm, cell.model);
    Twist command;
    before.setZero();
    for (int i = 0; i < 1400; ++i) {
      if (i % 700 == 0) command = random_twist(random);
      if (i == 0 && cell_name == "itself") command.head<3>() = towards_base(cell.arm, q);
      const long allocated = allocations;
      const ServoStep step = servo.step(q, command, v);
      ASSERT_EQ(allocations, allocated);
      if (step.limit == ServoLimit::clearance) ++held;
      ASSERT_TRUE(step.proved);
      ASSERT_EQ(step.bodies.has_value(), step.limit == ServoLimit::clearance);
      cell.expect_kept(q, v, before);
      if (::testing::Test::HasFatalFailure()) return;
      q += loop_step * v;
      before = v;
    }
  }
  EXPECT_GT(held, 0);
}

class AnyCommand : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(AnyCommand, KeepsTheClearanceAndTheLimits) {
  const auto& [name, cell] = GetParam();
  expect_clearance_for_random_commands(name, cell, LoopLimits::accelerations);
}

TEST_P(AnyCommand, KeepsTheClearanceWithVelocityLimitsAlone) {
  const auto& [name, cell] = GetParam();
  expect_clearance_for_random_commands(name, cell, LoopLimits::velocities_alone);
}

INSTANTIATE_TEST_SUITE_P(Servo, AnyCommand,
                         ::testing::Combine(::testing::Values("panda", "ur5e"),
                                            ::testing::Values("wall", "corner", "itself")));

/// The panda with its tool in front of a wall at x = 0.55 m, at rest.
struct AtWall {
  AtWall() : cell("panda", "wall", LoopLimits::accelerations), q(7), v(7) {
    q << 0, -0.3, 0, -2.2, 0, 2.0, 0.785;
  }

  /// Moves by the command for so many steps. Returns the least scale of the last half.
  double move(Servo& servo, const Twist& command, int steps) {
    double least = 1;
    for (int i = 0; i < steps; ++i) {
      last = servo.step(q, command, v);
      if (i >= steps / 2) least = std::min(least, last.scale);
      q += loop_step * v;
      lowest = std::min(lowest, excess_at(cell.model, q));
    }
    return least;
  }

  Vector3 tool() const { return forward_kinematics(cell.arm, q).translation(); }

  Cell cell;
  Configuration q;
  Eigen::VectorXd v;
  ServoStep last;
  double lowest = 1;
};

const Twist into_wall = 0.2 * Twist::Unit(0), along_wall = 0.2 * Twist::Unit(1);

TEST(ServoClearance, ApproachesSlowlyAndStopsAtTheClearance) {
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  double last = excess_at(at.cell.model, at.q);
  for (int i = 0; i < 3000; ++i) {
    at.move(servo, into_wall, 1);
    const double excess = excess_at(at.cell.model, at.q);
    ASSERT_LE(last - excess, 10 * loop_step * last + 1e-7) << i;  // the damper's gain is 10
    last = excess;
  }
  EXPECT_GE(at.lowest, -distance_rounding);
  EXPECT_LT(excess_at(at.cell.model, at.q), 1e-4);
  EXPECT_LT(at.last.scale, 1e-3);
  EXPECT_EQ(at.last.limit, ServoLimit::clearance);
  ASSERT_TRUE(at.last.bodies.has_value());
  EXPECT_EQ((*at.last.bodies)[1], "wall");
}

TEST(ServoClearance, MovesFreelyAlongAndAwayFromTheWall) {
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  at.move(servo, into_wall, 3000);
  const double before = at.tool().y();
  EXPECT_GT(at.move(servo, along_wall, 600), 1 - 1e-3);
  EXPECT_GT(at.tool().y() - before, 0.1);
  EXPECT_LT(excess_at(at.cell.model, at.q), 2e-3);
  EXPECT_GT(at.move(servo, -along_wall, 600), 1 - 1e-3);
  const double x = at.tool().x();
  EXPECT_GT(at.move(servo, -into_wall, 400), 1 - 1e-3);
  EXPECT_LT(at.tool().x() - x, -0.06);
  EXPECT_GE(at.lowest, -distance_rounding);
}

TEST(ServoClearance, SlidesAlongTheWallThatItIsPushedInto) {
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  at.move(servo, into_wall, 3000);
  const Vector3 before = at.tool();
  const Rotation turned = forward_kinematics(at.cell.arm, at.q).linear();
  const Twist both = into_wall + along_wall;
  const double scale = at.move(servo, both, 600);
  EXPECT_NEAR(scale, 0.5, 0.02);  // half of |command|^2
  EXPECT_EQ(at.last.limit, ServoLimit::clearance);
  EXPECT_GT(at.tool().y() - before.y(), 0.1);
  EXPECT_LT(so3_log(turned.transpose() * forward_kinematics(at.cell.arm, at.q).linear()).norm(),
            0.02);
  EXPECT_GE(at.lowest, -distance_rounding);
}

TEST(ServoClearance, MovesOutOfAClearanceAndOfABody) {
  for (const double depth : {0.004, 0.03}) {  // below the clearance of 0.01 m, and inside
    AtWall at;
    Servo servo(at.cell.arm, {.model = &at.cell.model});
    at.move(servo, into_wall, 3000);
    Servo free(at.cell.arm);
    for (const double deep = at.tool().x() + depth; at.tool().x() < deep;)
      at.move(free, into_wall, 1);
    Servo again(at.cell.arm, {.model = &at.cell.model});
    const double within = excess_at(at.cell.model, at.q);
    ASSERT_LT(within, -depth / 2);
    at.lowest = 1;
    at.move(again, into_wall, 200);
    EXPECT_GE(at.lowest, within - distance_rounding);
    EXPECT_EQ(at.last.limit, ServoLimit::clearance);
    EXPECT_GT(at.move(again, -into_wall, 600), 1 - 1e-3);
    EXPECT_GE(at.lowest, within - distance_rounding);
    EXPECT_GT(excess_at(at.cell.model, at.q), 0);
  }
}

TEST(ServoClearance, MovesBackFromOutsideThePositionLimits) {
  AtWall at;
  at.q[6] = at.cell.arm.limits(6).upper + 0.01;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  Twist turn = jacobian(at.cell.arm, at.q).col(6);
  at.move(servo, turn, 100);
  EXPECT_LE(at.q[6], at.cell.arm.limits(6).upper + 0.01);
  at.move(servo, -turn, 300);
  EXPECT_LT(at.q[6], at.cell.arm.limits(6).upper);
}

/// An arm that is not where the last step left it: each step proves what follows from the q that
/// it gets.
TEST(ServoClearance, KeepsTheClearanceFromMeasuredConfigurations) {
  testing::Random random;
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  for (int i = 0; i < 3000; ++i) {
    Configuration measured = at.q;
    for (double& value : measured) value += random.uniform(-1e-5, 1e-5);
    servo.step(measured, into_wall, at.v);
    at.q += loop_step * at.v;
    ASSERT_GE(excess_at(at.cell.model, at.q), -1e-4) << i;
  }
}

/// The arm is set nearer to the wall while it moves towards it.
TEST(ServoClearance, SaysThatAStepIsNotProved) {
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  while (excess_at(at.cell.model, at.q) > 1e-3) {
    at.move(servo, into_wall, 1);
    ASSERT_TRUE(at.last.proved);
  }
  ASSERT_GT(at.v.norm(), 1e-3);
  at.q += 1e-3 / at.v.norm() * at.v;
  while (excess_at(at.cell.model, at.q) > -1e-5) at.q += 1e-3 * at.v;
  at.move(servo, into_wall, 1);
  EXPECT_FALSE(at.last.proved);
  at.move(servo, into_wall, 200);  // it has stopped
  EXPECT_TRUE(at.last.proved);
}

TEST(ServoClearance, CopiesContinueIndependently) {
  AtWall at;
  Servo servo(at.cell.arm, {.model = &at.cell.model});
  at.move(servo, into_wall, 300);
  Servo copy = servo;
  Eigen::VectorXd other(7);
  for (int i = 0; i < 50; ++i) servo.step(at.q, -into_wall, other);
  Servo twin = copy;
  twin.step(at.q, into_wall, other);
  copy.step(at.q, into_wall, at.v);
  EXPECT_EQ(at.v, other);
}

TEST(ServoClearance, CopiesOfANewServoDoTheSameWithoutAllocations) {
  AtWall at;
  const Servo made(at.cell.arm, {.model = &at.cell.model});
  Servo copy = made, twin = made;
  Eigen::VectorXd other(7);
  for (int i = 0; i < 1500; ++i) {
    const long allocated = allocations;
    copy.step(at.q, into_wall + along_wall, at.v);
    ASSERT_EQ(allocations, allocated);
    twin.step(at.q, into_wall + along_wall, other);
    ASSERT_EQ(at.v, other);
    at.q += loop_step * at.v;
  }
  EXPECT_GT(at.tool().y(), 0.1);
}

TEST(ServoClearance, StepsNameTheBodies) {
  std::ostringstream text;
  text << ServoStep{0.5, ServoLimit::clearance, std::nullopt, BodyNames{"hand", "wall"}};
  EXPECT_EQ(text.str(), "scale 0.5, limit clearance of hand and wall");
  text.str("");
  text << ServoStep{.proved = false};
  EXPECT_EQ(text.str(), "scale 1, limit none, not proved");
}

TEST(ServoClearance, RefusesAnotherArmAndInvalidGains) {
  const Cell cell("panda", "wall", LoopLimits::accelerations);
  EXPECT_REFUSED((Servo(built_in("ur5e"), {.model = &cell.model})), "another arm");
  EXPECT_REFUSED((Servo(with_mount(cell.arm, make_pose({0, 0, 1})), {.model = &cell.model})),
                 "another base");
  EXPECT_REFUSED((Servo(cell.arm, {.model = &cell.model, .damper_gain = 0})), "damper gain");
  EXPECT_REFUSED((Servo(cell.arm, {.model = &cell.model, .damper_gain = 2000})), "at most");
}

}  // namespace
}  // namespace beeline
