#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

#include <beeline/control/servo.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double dt = 1e-3;
constexpr double rounding = 1e-9;

/// The built-in arm with accelerations, and velocities, where it has none.
Arm with_accelerations(const std::string& name) {
  const Arm arm = built_in(name);
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    if (!std::isfinite(joint.limits.acceleration)) joint.limits.acceleration = 8;
    if (!std::isfinite(joint.limits.velocity)) joint.limits.velocity = 2.5;
  }
  return Arm(name, joints, arm.tool(), arm.base());
}

Twist random_command(testing::Random& random) {
  Twist command;
  command << random.vector(), random.vector(2);
  return command;
}

double largest_excess(const Eigen::VectorXd& values, const Arm& arm, double Limits::*kind) {
  double excess = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    excess = std::max(excess, std::abs(values[k]) - arm.limits(k).*kind);
  }
  return excess;
}

TEST(Servo, KeepsAllLimitsForAnyCommand) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14", "rrr", "scara", "stanford"}) {
    const Arm arm = with_accelerations(name);
    for (int run = 0; run < 10; ++run) {
      Servo servo(arm);
      Configuration q = 0.9 * random.configuration(arm) + 0.1 * middle_configuration(arm);
      Eigen::VectorXd v(arm.dof()), before = Eigen::VectorXd::Zero(arm.dof());
      Twist command = random_command(random);
      for (int i = 0; i < 4000; ++i) {
        if (i % 500 == 0) command = random_command(random);
        const ServoStep step = servo.step(q, command, v);
        ASSERT_TRUE(v.allFinite()) << name << ' ' << run;
        ASSERT_GE(step.scale, 0);
        ASSERT_LE(step.scale, 1);
        ASSERT_LT(largest_excess(v, arm, &Limits::velocity), rounding) << name;
        ASSERT_LT(largest_excess((v - before) / dt, arm, &Limits::acceleration), 1e-6) << name;
        q += v * dt;
        ASSERT_TRUE(limit_violations(arm, q).empty()) << limit_violations(arm, q).front();
        before = v;
      }
    }
  }
}

TEST(Servo, AchievesACommandWithinTheLimits) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    int whole = 0;
    for (int i = 0; i < 1000; ++i) {
      Servo servo(arm);
      const Configuration q = 0.8 * random.configuration(arm) + 0.2 * middle_configuration(arm);
      const Twist command = 1e-3 * random_command(random);
      Eigen::VectorXd v(arm.dof());
      const ServoStep step = servo.step(q, command, v);
      const Twist moved = jacobian(arm, q) * v;
      const double error = (moved - step.scale * command).norm() / command.norm();
      if (step.limit == ServoLimit::none) {
        ++whole;
        ASSERT_LT(error, 1e-6) << name << ' ' << step;
        ASSERT_NEAR(step.scale, 1, 1e-6) << name;
        continue;
      }
      ASSERT_LT(step.scale, 1) << name << ' ' << step;
      if (step.limit == ServoLimit::singular) continue;  // other directions may have a velocity too
      ASSERT_TRUE(step.joint.has_value()) << name << ' ' << step;
      // From rest, no limit changes the direction.
      ASSERT_LT(error, 1e-6) << name << ' ' << step;
    }
    EXPECT_GT(whole, 800) << name;
  }
}

TEST(Servo, ReportsTheLimitInTheDirectionOfMotion) {
  Joint slide = built_in("gantry").joints()[0];
  slide.limits = {.lower = 0, .upper = 1, .velocity = 0.5};
  const Arm arm("slide", {slide});
  const Twist unit = jacobian(arm, Configuration::Zero(1)).col(0);
  for (const double q : {1e-4, 1 - 1e-4}) {  // 0.1 m/s from a stop in one step
    for (const double sign : {-1.0, 1.0}) {
      Servo servo(arm, {.task = Task::position()});
      Eigen::VectorXd v(1);
      const ServoStep step = servo.step(Configuration::Constant(1, q), 2 * sign * unit, v);
      const bool towards_end = (q < 0.5) == (sign < 0);
      EXPECT_EQ(step.limit, towards_end ? ServoLimit::position : ServoLimit::velocity);
      EXPECT_NEAR(v[0], sign * (towards_end ? 0.1 : 0.5), 1e-9);
    }
  }
}

TEST(Servo, KeepsTheCommandedDirectionNextToSingularities) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5"}) {
    const Arm arm = with_accelerations(name);
    int against = 0;
    for (int i = 0; i < 200; ++i) {
      Servo servo(arm);
      Configuration q = 0.4 * random.configuration(arm);
      q[4] = random.uniform(-1, 1) * std::pow(10, random.uniform(-9, -1));  // the wrist's
      const Twist command = 0.2 * random_command(random);
      Eigen::VectorXd v(arm.dof());
      double least = 0;
      for (int k = 0; k < 300; ++k) {
        const ServoStep step = servo.step(q, command, v);
        const Twist moved = jacobian(arm, q) * v;
        least = std::min(least, moved.dot(command) / command.squaredNorm());
        q += v * dt;
        if (step.limit == ServoLimit::position) break;
      }
      // If the acceleration limits do not suffice for a rotation, the direction deviates slightly.
      ASSERT_GT(least, -0.02) << name << ' ' << i;
      if (least < -1e-4) ++against;
    }
    EXPECT_LE(against, 4) << name;
  }
}

TEST(Servo, IsNotSlowedByASingularityThatTheCommandDoesNotExcite) {
  const Arm arm = with_accelerations("puma560");
  Configuration q(6);
  q << 0.3, 0.8, -0.6, 0.4, -0.5, 0.2;
  Servo servo(arm);
  Eigen::VectorXd v(6);
  const Twist command = jacobian(arm, q).col(4);  // about the wrist's middle axis, which is fixed
  double least = 1;
  for (int i = 0; q[4] < 0.5; ++i) {
    ASSERT_LT(i, 2000);
    const ServoStep step = servo.step(q, command, v);
    if (i > 200) least = std::min(least, step.scale);
    q += v * dt;
  }
  EXPECT_GT(least, 1 - 1e-6);
}

TEST(Servo, StaysOnItsLineWhenTheCommandIsReversed) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "panda"}) {
    const Arm arm = with_accelerations(name);
    int runs = 0, reversed = 0, slowed = 0;
    for (int i = 0; i < 400 && runs < 20; ++i) {
      Configuration q = 0.5 * random.configuration(arm) + 0.5 * middle_configuration(arm);
      if (manipulability_measures(jacobian(arm, q)).manipulability < 0.01) continue;
      ++runs;
      Servo servo(arm);
      Eigen::VectorXd v(arm.dof());
      const Twist command = 0.1 * random_command(random);
      for (int k = 0; k < 400; ++k) {
        const ServoStep step = servo.step(q, k < 200 ? command : Twist(-command), v);
        if (step.limit == ServoLimit::position) break;
        const Twist moved = jacobian(arm, q) * v;
        const double along = moved.dot(command) / command.squaredNorm();
        ASSERT_LT((moved - along * command).norm(), 1e-6 * command.norm()) << name << ' ' << i;
        if (k == 200 && step.limit == ServoLimit::acceleration) ++slowed;
        if (k == 399 && std::abs(along + 1) < 1e-6) ++reversed;
        q += v * dt;
      }
    }
    EXPECT_EQ(runs, 20) << name;
    EXPECT_GE(slowed, 15) << name;    // the reversal takes more than one step
    EXPECT_GE(reversed, 10) << name;  // and then the whole command is achieved
  }
}

TEST(Servo, RetreatsFromAStretchedOutPose) {
  const Arm arm = built_in("rrr");
  for (const double bend : {0.0, 1e-12, 1e-7, 1e-4}) {
    Configuration q(3);
    q << 0.3, bend, 0;  // all links on a line, or nearly
    const Vector3 out = forward_kinematics(arm, q).translation().normalized();
    Twist command = Twist::Zero();
    command.head<3>() = -0.5 * out;
    Servo servo(arm);
    Eigen::VectorXd v(3);
    const double far = forward_kinematics(arm, q).translation().norm();
    for (int i = 0; i < 2000; ++i) {
      servo.step(q, command, v);
      q += v * dt;
      ASSERT_LE(forward_kinematics(arm, q).translation().norm(), far + 1e-9);
    }
    EXPECT_LT(forward_kinematics(arm, q).translation().norm(), far - 0.4) << bend;

    Servo outward(arm);
    q << 0.3, 0, 0;
    command = -command;
    const ServoStep step = outward.step(q, command, v);
    EXPECT_EQ(step.limit, ServoLimit::singular);
    EXPECT_LT(step.scale, 1e-6);
    EXPECT_LT(v.norm(), 1e-6);
  }
}

TEST(Servo, MovesTheOtherJointsWhereOneIsAtItsLimit) {
  const Arm arm = built_in("panda");
  testing::Random random;
  int at_limit = 0;
  for (int i = 0; i < 500; ++i) {
    Configuration q = 0.6 * random.configuration(arm) + 0.4 * middle_configuration(arm);
    const int k = random.integer(0, 6);
    q[k] = random.integer(0, 1) == 0 ? arm.limits(k).lower : arm.limits(k).upper;
    Servo servo(arm);
    Eigen::VectorXd v(7);
    Twist command = 1e-3 * random_command(random);
    const ServoStep step = servo.step(q, command, v);
    if (step.limit == ServoLimit::position) continue;  // the others cannot
    ++at_limit;
    ASSERT_TRUE(limit_violations(arm, q + v * dt).empty());
  }
  EXPECT_GT(at_limit, 450);
}

TEST(Servo, ReachesAPoseUnlessASingularityIsOnThePath) {
  testing::Random random;
  for (const char* name : {"ur5", "panda", "rrr"}) {
    const Arm arm = with_accelerations(name);
    const Task task = default_task(arm);
    int reached = 0;
    const int poses = testing::cases(20);
    for (int i = 0; i < poses; ++i) {
      Configuration q = 0.5 * random.configuration(arm) + 0.5 * middle_configuration(arm);
      Configuration aside = q;
      for (int k = 0; k < arm.dof(); ++k) aside[k] += random.uniform(-0.2, 0.2);
      const Pose goal = forward_kinematics(arm, aside);
      Servo servo(arm, {.linear_speed = 0.5, .angular_speed = 1});
      Eigen::VectorXd v(arm.dof());
      ServoStep last;
      for (int k = 0; k < 10000; ++k) {
        last = servo.step_towards(q, goal, v);
        q += v * dt;
      }
      const Deviation left = task_deviation(task, goal, forward_kinematics(arm, q));
      if (left.position < 1e-6 && left.orientation < 1e-6) {
        ++reached;
      } else if (last.limit == ServoLimit::singular) {  // such as the stretched elbow
        EXPECT_LT(manipulability_measures(task_jacobian(arm, q, task)).singular_values.minCoeff(),
                  1e-4)
            << name;
        EXPECT_LT(v.norm(), 1e-3);
      } else {
        EXPECT_EQ(last.limit, ServoLimit::position) << name << ' ' << i;
      }
    }
    EXPECT_GE(reached, poses * 3 / 4) << name;
  }
}

TEST(Servo, CopiesContinueIndependentlyAndMovesKeepTheState) {
  const Arm arm = with_accelerations("panda");
  Configuration q = middle_configuration(arm);
  Servo servo(arm);
  Eigen::VectorXd v(7), other(7);
  const Twist command = Twist::Constant(0.1);
  for (int i = 0; i < 20; ++i) {
    servo.step(q, command, v);
    q += v * dt;
  }
  Servo copy = servo;
  servo.step(q, -command, v);  // does not change the copy
  Servo assigned(built_in("rrr"));
  assigned = copy;
  Servo moved = std::move(copy);
  const ServoStep step = assigned.step(q, command, v);
  EXPECT_EQ(moved.step(q, command, other).scale, step.scale);
  EXPECT_EQ(v, other);
  copy = Servo(arm);
  copy.step(q, command, other);  // from rest
  EXPECT_LT(other.norm(), v.norm());
}

TEST(Servo, StepsArePrinted) {
  std::ostringstream text;
  text << ServoStep{} << "; " << ServoStep{0.5, ServoLimit::velocity, 1};
  EXPECT_EQ(text.str(), "scale 1, limit none; scale 0.5, limit velocity of joint 2");
}

TEST(Servo, RefusesInvalidArguments) {
  const Arm arm = built_in("ur5");
  EXPECT_REFUSED((Servo(arm, {.time_step = 0})), "time step");
  EXPECT_REFUSED((Servo(arm, {.gain = 2000})), "at most 1 / time step");
  EXPECT_REFUSED((Servo(arm, {.linear_speed = -1})), "speeds");
  Servo servo(arm);
  Eigen::VectorXd v(5), six(6);
  EXPECT_REFUSED((servo.step(Configuration::Zero(6), Twist::Zero(), v)), "has 5 elements");
  Twist bad = Twist::Constant(NAN);
  EXPECT_REFUSED((servo.step(Configuration::Zero(6), bad, six)), "finite");
}

TEST(Servo, RefusesAVelocityBeyondTheLimits) {
  const Arm arm = with_accelerations("panda");
  const Configuration q = middle_configuration(arm);
  Servo servo(arm), other(arm);
  Eigen::VectorXd within(7), v(7), same(7);
  for (int k = 0; k < 7; ++k) within[k] = (k % 2 == 0 ? 1 : -1) * arm.limits(k).velocity;
  servo.set_velocity(within);
  other.set_velocity(within);
  for (int k = 0; k < 7; ++k) {
    Configuration beyond = within;
    beyond[k] *= 1.00001;
    const std::string refused = testing::refusal([&] { servo.set_velocity(beyond); });
    EXPECT_NE(refused.find("joint" + std::to_string(k + 1)), std::string::npos) << refused;
    EXPECT_NE(refused.find(number(arm.limits(k).velocity)), std::string::npos) << refused;
    beyond[k] = NAN;
    EXPECT_REFUSED(servo.set_velocity(beyond), "finite");
  }
  // A refused velocity changes nothing, and after an accepted one the limits hold.
  servo.step(q, Twist::Constant(0.1), v);
  other.step(q, Twist::Constant(0.1), same);
  EXPECT_EQ(v, same);
  EXPECT_LT(largest_excess(v, arm, &Limits::velocity), rounding);
}

}  // namespace
}  // namespace beeline
