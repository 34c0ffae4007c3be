// How the tracker follows: without lag within the limits, without overshoot after a jump, through
// singularities and back from beyond reach.

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

#include <beeline/control/tracker.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/random.h>

namespace beeline {
namespace {

constexpr double step_time = 1e-3;
using std::numbers::pi;

double largest_part(const Deviation& error) { return std::max(error.position, error.orientation); }

/// A configuration far from the limits and from singularities, different at each call.
Configuration regular_configuration(const Arm& arm, testing::Random& random) {
  const Task task = default_task(arm);
  for (;;) {
    const Configuration q = 0.6 * random.configuration(arm) + 0.4 * middle_configuration(arm);
    const auto measures = manipulability_measures(task_jacobian(arm, q, task, arm.reach().radius));
    if (measures.singular_values.minCoeff() > 0.1) return q;
  }
}

/// A pose within 0.3 m and 1 rad of `pose` in the arm's task, which may be out of reach.
Pose pose_near(const Arm& arm, const Pose& pose, testing::Random& random) {
  Pose near = pose;
  Vector3 offset = random.uniform(0, 0.3) * random.direction();
  Vector3 axis = random.direction();
  if (arm.planar()) offset[2] = 0;
  if (arm.rotates_about_z()) axis = Vector3::UnitZ();
  near.translation() += offset;
  near.linear() = so3_exp(random.uniform(-1, 1) * axis) * near.linear();
  return near;
}

/// The largest component of the gradient of |task error|^2 / 2 along which the limits leave room,
/// relative to the norms of the Jacobian and the error.
double relative_gradient(const Arm& arm, const Configuration& q, const Pose& goal) {
  const Task task = default_task(arm);
  const double unit = arm.reach().radius;
  const Eigen::MatrixXd j = task_jacobian(arm, q, task, unit);
  Eigen::VectorXd error = task_error(task, goal, forward_kinematics(arm, q));
  error.head(task.positions()) /= unit;
  const Eigen::VectorXd gradient = j.transpose() * error;
  double largest = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    const double end = gradient[k] > 0 ? arm.limits(k).upper : arm.limits(k).lower;
    if (std::abs(q[k] - end) > 1e-6) largest = std::max(largest, std::abs(gradient[k]));
  }
  return largest / (j.norm() * error.norm());
}

/// Steps until the tool is at the goal to 1e-9, or for 10 s. Returns the steps that this takes.
int steps_to(Tracker& tracker, const Pose& goal) {
  constexpr int max_steps = 10000;
  for (int i = 1; i < max_steps; ++i) {
    if (largest_part(tracker.step(goal).error) < 1e-9) return i;
  }
  return max_steps;
}

TEST(Tracker, ConvergesToPosesNearby) {
  struct Case {
    const char* name;
    double min_rate;  // docs/benchmarks.md has what was measured
  };
  testing::Random random;
  for (const Case& arm_case : {Case{"rrr", 0.9},
                               {"puma560", 0.45},
                               {"ur5", 0.5},
                               {"ur5e", 0.5},
                               {"panda", 0.5},
                               {"iiwa14", 0.7},
                               {"scara", 0.6},
                               {"stanford", 0.45}}) {
    const Arm arm = built_in(arm_case.name);
    int reached = 0, poses = 0;
    while (poses < std::max(20, testing::cases(40))) {  // a rate needs that many
      const Configuration q = random.configuration(arm);
      const Pose goal = pose_near(arm, forward_kinematics(arm, q), random);
      if (!inverse_kinematics(arm, goal, {.seed = q})) continue;
      ++poses;
      Tracker tracker(arm, q);
      const int steps = steps_to(tracker, goal);
      const TrackerStep last = tracker.step(goal);
      if (largest_part(last.error) < 1e-9) {
        EXPECT_EQ(last.status, TrackerStatus::following);
        ++reached;
        for (int i = 0; i < 1000; ++i) tracker.step(goal);
        EXPECT_LT(largest_part(tracker.step(goal).error), 1e-11) << arm_case.name;
        EXPECT_LT(tracker.velocity().lpNorm<Eigen::Infinity>(), 1e-9) << arm_case.name;
      } else {  // at a minimum of the error within the limits, or a singularity
        EXPECT_LT(relative_gradient(arm, last.q, goal), 2e-3) << arm_case.name << ' ' << last;
        EXPECT_LT(last.velocity.norm(), 1e-3) << steps << last;
      }
    }
    EXPECT_GE(reached, arm_case.min_rate * poses) << arm_case.name;
    std::cout << arm_case.name << ": " << reached << " of " << poses << " poses reached\n";
  }
}

TEST(Tracker, FollowsAPlannedMotionWithoutLag) {
  testing::Random random;
  for (const char* name : {"rrr", "puma560", "ur5", "panda", "iiwa14", "scara"}) {
    const Arm arm = built_in(name);
    // Its own motion in the null space may need more than the limits of the planned motion.
    const bool redundant = arm.dof() > default_task(arm).size();
    int motions = 0, without_lag = 0;
    for (int i = 0; i < 200 && motions < testing::cases(10); ++i) {
      const Configuration q = regular_configuration(arm, random);
      const Pose goal = pose_near(arm, forward_kinematics(arm, q), random);
      const PathMotion motion =
          move_in_lines(with_speed_scale(arm, redundant ? 0.3 : 1), q, {goal});
      if (!motion || motion.inverse_condition < 0.02 || motion.limit_margin < 0.1) continue;
      ++motions;
      Tracker tracker(arm, q);
      const double duration = motion.trajectory.times.back();
      double largest = 0;
      for (double t = step_time; t < duration + step_time; t += step_time) {
        const Configuration at = sample(motion.trajectory, std::min(t, duration)).position;
        const TrackerStep& step = tracker.step(forward_kinematics(arm, at));
        largest = std::max(largest, largest_part(step.error));
        if (redundant) continue;
        ASSERT_LT(largest, 1e-6) << name << ' ' << i << " at " << t << step;
        ASSERT_LT((step.q - at).norm(), 1e-4) << name;
      }
      if (largest < 1e-6) ++without_lag;
    }
    EXPECT_EQ(motions, testing::cases(10)) << name;
    EXPECT_GE(without_lag, 0.6 * motions) << name;
  }
}

TEST(Tracker, DoesNotOvershootAfterAJump) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "ur5e", "panda", "iiwa14", "scara", "stanford"}) {
    const Arm arm = built_in(name);
    for (int run = 0; run < testing::cases(20); ++run) {
      const Configuration q = regular_configuration(arm, random);
      Configuration aside = q;
      for (int k = 0; k < arm.dof(); ++k) aside[k] += random.uniform(-0.1, 0.1);
      const Pose goal = forward_kinematics(arm, aside);
      Tracker tracker(arm, q);
      Tracker ahead(arm, q);
      if (steps_to(ahead, goal) > 2000) continue;  // at a limit
      const Configuration end = ahead.configuration();
      for (int i = 0; i < 2000; ++i) {
        const Configuration& now = tracker.step(goal).q;
        for (int k = 0; k < arm.dof(); ++k) {
          const double beyond = (now[k] - end[k]) * (end[k] > q[k] ? 1 : -1);
          ASSERT_LT(beyond, 1e-8) << name << ' ' << k;
        }
      }
    }
  }
}

TEST(Tracker, StopsWithTheCommand) {
  // A command at constant velocity that stops at once: v^2 / (2 a) of overshoot cannot be avoided.
  const Arm arm = built_in("ur5");
  Configuration q(6);
  q << 0.3, -1.2, 1.6, -0.8, -1.2, 0.2;
  Tracker tracker(arm, q);
  for (int i = 0; i < 1000; ++i) {
    q[0] += 0.5 * step_time;
    tracker.step(forward_kinematics(arm, q));
  }
  double farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    farthest = std::max(farthest, tracker.step(forward_kinematics(arm, q)).q[0] - q[0]);
  }
  EXPECT_LT(farthest, 0.5 * 0.5 / (2 * 4) + 0.5 * step_time);
  EXPECT_LT(largest_part(tracker.step(forward_kinematics(arm, q)).error), 1e-12);
}

TEST(Tracker, StaysOnItsBranch) {
  testing::Random random;
  for (const char* name : {"puma560", "ur5", "stanford", "scara", "rrr"}) {
    const Arm arm = built_in(name);
    for (int run = 0; run < testing::cases(10); ++run) {
      const Configuration q = regular_configuration(arm, random);
      const Pose pose = forward_kinematics(arm, q);
      Tracker tracker(arm, q);
      const Vector3 sizes = random.vector(0.005 * arm.reach().radius);
      const double spin = random.uniform(-0.02, 0.02);
      for (int i = 0; i <= 6000; ++i) {  // three rounds, closed
        const double angle = 2 * pi * i / 2000;
        const double eased = 1 - std::cos(angle);
        Pose command = pose;
        command.translation() += Vector3(sizes[0] * eased, sizes[1] * std::sin(angle) * eased,
                                         arm.planar() ? 0 : sizes[2] * eased * eased);
        command.linear() = so3_exp(spin * eased * Vector3::UnitZ()) * pose.linear();
        tracker.step(command);
      }
      for (int i = 0; i < 1000; ++i) tracker.step(pose);
      EXPECT_LT((tracker.configuration() - q).lpNorm<Eigen::Infinity>(), 1e-9) << name;
    }
  }
}

TEST(Tracker, ReturnsFromBeyondReach) {
  for (const char* name : {"ur5", "puma560", "rrr"}) {
    const Arm arm = built_in(name);
    Configuration q(arm.dof());
    if (arm.dof() == 3) q << 0.3, 0.9, -0.4;
    if (arm.name() == "ur5") q << 0.3, -0.7, 1.2, -0.5, 1, 0.2;
    if (arm.name() == "puma560") q << 0.3, 0.7, -1.2, -0.5, 1, 0.2;
    const Pose pose = forward_kinematics(arm, q);
    const double reach = arm.reach().radius;
    Vector3 outward = pose.translation() - arm.reach().centre;
    if (arm.planar()) outward[2] = 0;
    outward.normalize();
    for (const double speed : {0.5, 3.0}) {  // reaches per second
      Tracker tracker(arm, q);
      TrackerStatus farthest = TrackerStatus::following;
      const double distance = 1.5 * reach;
      const int there = static_cast<int>(distance / (reach * speed) / step_time);
      for (int i = 0; i < 2 * there + 2000; ++i) {
        const double travelled = std::min({1.0 * i, there + 1000.0, 2.0 * there + 1000 - i});
        Pose command = pose;
        command.translation() +=
            outward * reach * speed * step_time * std::clamp(travelled, 0.0, 1.0 * there);
        const TrackerStep& step = tracker.step(command);
        if (i == there + 500) farthest = step.status;
      }
      EXPECT_NE(farthest, TrackerStatus::following) << name;
      EXPECT_LT(steps_to(tracker, pose), 10000) << name;
    }
  }
}

TEST(Tracker, LeavesSingularConfigurations) {
  for (const char* name : {"rrr", "ur5", "ur5e", "iiwa14", "puma560"}) {
    const Arm arm = built_in(name);
    Configuration q = Configuration::Zero(arm.dof());  // stretched out, wrist singular
    if (arm.name() == "puma560") q[2] = -1.5;          // the wrist is singular
    const Pose pose = forward_kinematics(arm, q);
    Vector3 inward = arm.reach().centre - pose.translation();
    if (arm.planar()) inward[2] = 0;
    Pose goal = pose;
    goal.translation() += 0.15 * inward;
    ASSERT_TRUE(inverse_kinematics(arm, goal)) << name;
    Tracker tracker(arm, q);
    EXPECT_LT(steps_to(tracker, goal), 10000) << name << tracker.step(goal);
  }
}

TEST(Tracker, PassesTheWristSingularity) {
  // The command rotates the wrist through q5 = 0, or past it at a distance.
  const Arm arm = built_in("puma560");
  Configuration q(6);
  q << 0.2, 0.8, -0.6, 0.4, 0, 0.3;
  const Pose middle = forward_kinematics(arm, q);
  const Jacobian j = jacobian(arm, q);
  const Vector3 axis = j.col(4).tail<3>(), aside = j.col(3).tail<3>().cross(axis);
  for (const double distance : {0.0, 1e-9, 1e-6, 1e-4, 1e-3}) {
    const auto pose_at = [&](double angle) {
      Pose pose = middle;
      pose.linear() = so3_exp(distance * aside) * so3_exp(angle * axis) * middle.linear();
      return pose;
    };
    q[4] = -0.5;
    Tracker tracker(arm, q);
    double largest = 0;
    for (int i = 0; i < 4000; ++i) {
      const double angle = -0.5 * std::cos(pi * i / 4000);
      largest = std::max(largest, largest_part(tracker.step(pose_at(angle)).error));
    }
    EXPECT_LT(largest, 1e-6 + 100 * distance) << distance;
    EXPECT_LT(steps_to(tracker, pose_at(0.5)), 1000) << distance;
    EXPECT_NEAR(tracker.configuration()[4], 0.5, 1e-2);
    EXPECT_NEAR(tracker.configuration()[3], 0.4, 1e-2);
  }
}

TEST(Tracker, FollowsCommandsAtALowerRateInACommandPeriod) {
  const Arm arm = built_in("ur5");
  Configuration q(6);
  q << 0.3, -1.2, 1.6, -0.8, -1.2, 0.2;
  const Pose pose = forward_kinematics(arm, q);
  const auto command_at = [&](double t) {
    Pose command = pose;
    command.translation() += Vector3(0.1 * (std::cos(t) - 1), 0.1 * std::sin(t), 0);
    return command;
  };
  constexpr int period = 11;  // steps
  double with = 0, without = 0;
  Tracker tracker(arm, q, {.command_period = period * step_time}), at_once(arm, q);
  for (int i = 0; i < 5000; ++i) {
    const Pose command = command_at((i / period) * period * step_time);
    const Vector3 now = forward_kinematics(arm, tracker.step(command).q).translation();
    const Vector3 late = command_at((i + 1 - period) * step_time).translation();
    if (i > 500) with = std::max(with, (now - late).norm());
    without = std::max(without, at_once.step(command).error.position);
  }
  EXPECT_LT(with, 3e-6);
  EXPECT_GT(without, 1e-3);  // it stops and goes with each command
}

}  // namespace
}  // namespace beeline
