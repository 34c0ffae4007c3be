#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/joint_axes.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/families.h>

namespace beeline::internal {
namespace {

using testing::arm_through;
using testing::axes_with;
using testing::closed_form_solutions;
using testing::Counts;
using testing::example_size;
using testing::expect_every_solution;
using testing::holds;
using testing::Random;
using Family = PieperLoop::Family;

using std::numbers::pi;

const Task rolling = task_named("111110:tool");

/// The arm without its joints after the first `count`; its tool stays where it was.
Arm shortened(const Arm& arm, int count) {
  std::vector<Joint> joints(arm.joints().begin(), arm.joints().begin() + count);
  return {arm.name(), joints, arm.tool(), arm.base()};
}

/// Checks that random configurations are among the solutions of their poses, and that a numerical
/// search finds no further solution.
void expect_complete(const Arm& arm, const Task& task, int poses, Random& random, Counts& counts,
                     bool search = true) {
  for (int i = 0; i < poses; ++i) {
    const Configuration from = random.configuration(arm);
    Pose pose = forward_kinematics(arm, from);
    if (task == Task::position()) pose.linear() = random.rotation();
    if (task == rolling) pose.rotate(Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitZ()));
    expect_every_solution(arm, task, from, pose, random, search ? &counts : nullptr);
  }
}

TEST(PieperSolver, IsDescribedForTheBuiltInArms) {
  const std::vector<std::pair<const char*, const char*>> families{
      {"puma560", "closed form: three axes meet (joints 4, 5, 6)"},
      {"stanford", "closed form: three axes meet (joints 4, 5, 6)"},
      {"ur5", "closed form: three parallel axes (joints 2, 3, 4)"},
      {"ur5e", "closed form: three parallel axes (joints 2, 3, 4)"},
      {"panda", "closed form: three axes meet (joints 1, 2, 3)"},
      {"iiwa14", "closed form: three axes meet (joints 1, 2, 3)"},
      {"so101", "closed form: three parallel axes (joints 2, 3, 4)"},
      {"koch", "closed form: three parallel axes (joints 2, 3, 4)"},
      {"scara", "closed form: three parallel axes (joints 1, 2, 3)"}};
  for (const auto& [name, family] : families) {
    EXPECT_EQ(inverse_method(built_in(name)), family) << name;
  }
}

TEST(PieperSolver, OfFiveJointsIsComplete) {
  Random random;
  Counts counts;
  const Arm puma = shortened(built_in("puma560"), 5);
  for (const Task& task : {Task::spatial(), rolling}) {
    expect_complete(puma, task, example_size(200), random, counts, false);
    expect_complete(puma, task, 10, random, counts);
  }
  for (const Family family : {Family::intersecting, Family::parallel}) {
    for (std::size_t first = 0; first < 3; ++first) {
      for (int i = 0; i < example_size(20); ++i) {
        const Arm arm = arm_through(axes_with(family, first, "RRRRR", random), random);
        for (const Task& task : {Task::spatial(), rolling}) {
          expect_complete(arm, task, 10, random, counts, false);
          if (i < 3) expect_complete(arm, task, 1, random, counts);
        }
      }
    }
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses) << "of " << counts.poses;
}

// Virtual joints about the tool's z axis would only add to the last joint's angle.
TEST(PieperSolver, OfFiveJointsIsCompleteWithTheToolsAxesOnTheLastJointsAxis) {
  Random random;
  Counts counts;
  for (int i = 0; i < example_size(20); ++i) {
    const Arm arm = arm_through(axes_with(Family::parallel, 1, "RRRRR", random), random);
    const Joint& last = arm.joints().back();
    const Vector3 axis = last.screw.tail<3>();
    Pose tool = frame_along(axis.unitOrthogonal(), axis, Vector3::Zero());
    for (int k = i % 3; k < 2; ++k) {  // its axis i % 3 along the joint's
      tool = tool * Eigen::AngleAxisd(2 * std::numbers::pi / 3, Vector3(1, 1, 1).normalized());
    }
    tool.translation() = axis.cross(last.screw.head<3>()) + random.uniform(-1, 1) * axis;
    expect_complete({"coaxial", arm.joints(), tool}, Task::spatial(), 10, random, counts, i < 3);
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses) << "of " << counts.poses;
}

TEST(PieperSolver, OfFourJointsIsComplete) {
  Random random;
  Counts counts;
  expect_complete(built_in("scara"), Task::spatial(), example_size(300), random, counts, false);
  expect_complete(built_in("scara"), Task::spatial(), 10, random, counts);
  for (const Family family : {Family::intersecting, Family::parallel}) {
    for (const auto& [first, letters] :
         {std::pair<std::size_t, const char*>{0, "RRRR"}, {1, "RRRR"}, {0, "RRRP"}}) {
      for (int i = 0; i < example_size(20); ++i) {
        const Arm arm = arm_through(axes_with(family, first, letters, random), random);
        expect_complete(arm, Task::spatial(), 10, random, counts, false);
        if (i < 3) expect_complete(arm, Task::spatial(), 1, random, counts);
      }
    }
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses) << "of " << counts.poses;
}

TEST(PieperSolver, OfThreeJointsForThePositionIsComplete) {
  Random random;
  Counts counts;
  expect_complete(shortened(built_in("puma560"), 3), Task::position(), example_size(200), random,
                  counts, false);
  for (const char* letters : {"RRR", "RRP"}) {
    for (int i = 0; i < example_size(40); ++i) {
      std::vector<testing::Axis> axes;
      for (const char* letter = letters; *letter != 0; ++letter) {
        axes.push_back(testing::random_axis(random, *letter == 'P'));
      }
      const Arm arm = arm_through(axes, random);
      expect_complete(arm, Task::position(), 10, random, counts, false);
      if (i < 10) expect_complete(arm, Task::position(), 1, random, counts);
    }
  }
  EXPECT_GE(counts.equal, 0.95 * counts.poses) << "of " << counts.poses;
}

/// Three prismatic joints and a wrist have no closed form yet; the numerical method solves them.
TEST(PieperSolver, IsNotNeededForGantries) {
  Random random;
  for (const char* letters : {"PPPRRR", "RRPRRR", "PPRRRR", "RPRRRR"}) {
    for (int i = 0; i < example_size(20); ++i) {
      auto axes = axes_with(Family::intersecting, 3, letters, random);
      const bool square = i % 2 == 0 && axes[0].slides && axes[1].slides && axes[2].slides;
      for (int k = 0; k < 3 && square; ++k) axes[k].direction = Vector3::Unit(2 - k);
      const Arm arm = arm_through(axes, random);
      const Configuration from = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, from);
      testing::expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose));
      const InverseResult all = inverse_kinematics(arm, pose, {.all = true, .max_restarts = 300});
      EXPECT_TRUE(holds(arm, all.solutions, from)) << letters << ' ' << all.method;
    }
  }
}

/// Solves the poses of random configurations with the given value of coordinate k.
void expect_singular(const Arm& arm, int k, double value, bool singular, Random& random) {
  for (int i = 0; i < example_size(200); ++i) {
    Configuration q = random.configuration(arm);
    q[k] = value;
    const Pose pose = forward_kinematics(arm, q);
    const InverseResult result = inverse_kinematics(arm, pose, {.seed = q, .all = true});
    testing::expect_solved(arm, pose, Task::spatial(), result);
    EXPECT_EQ(result.singular, singular) << arm.name() << ' ' << q.transpose();
    // Near a double solution the joints have an error of the square root of rounding.
    EXPECT_TRUE(holds(arm, result.solutions, q, singular ? 1e-6 : 1e-4)) << q.transpose();
    const Configuration elsewhere = random.configuration(arm);
    testing::expect_solved(arm, pose, Task::spatial(),
                           inverse_kinematics(arm, pose, {.seed = elsewhere}));
  }
}

TEST(PieperSolver, ReportsAContinuumOfSolutions) {
  Random random;
  expect_singular(built_in("puma560"), 4, 0, true, random);  // axes of joints 4 and 6 coincide
  expect_singular(built_in("stanford"), 4, 0, true, random);
  for (const double value : {0.0, pi, -pi}) {  // joints 2, 3, 4 and 6 parallel
    expect_singular(built_in("ur5"), 4, value, true, random);
  }
}

TEST(PieperSolver, ReportsNoContinuumForAStretchedArm) {
  Random random;
  expect_singular(built_in("puma560"), 2, -std::atan2(0.4318, 0.0203), false, random);  // stretched
  expect_singular(built_in("ur5"), 2, 0, false, random);
  expect_singular(built_in("ur5"), 2, pi, false, random);  // folded back
}

/// However close to a singular pose.
TEST(PieperSolver, IsExactNearSingularPoses) {
  Random random;
  for (const double near : {1e-2, 1e-4, 1e-6, 1e-10, 1e-12, 1e-14}) {
    for (const auto& [name, k] :
         {std::pair{"puma560", 4}, {"stanford", 4}, {"ur5", 4}, {"ur5", 2}}) {
      const Arm arm = built_in(name);
      for (int i = 0; i < example_size(50); ++i) {
        Configuration q = random.configuration(arm);
        q[k] = near;
        const Pose pose = forward_kinematics(arm, q);
        testing::expect_solved(arm, pose, Task::spatial(),
                               inverse_kinematics(arm, pose, {.all = true}));
      }
    }
  }
}

TEST(PieperSolver, FindsEveryMultipleOfTwoPiOnce) {
  Random random;
  const Arm arm = built_in("ur5");  // limits of 2 pi to both sides: each angle has two values
  for (int i = 0; i < 20; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const auto postures = inverse_kinematics(arm, pose, {.all = true}).solutions;
    const InverseResult every = inverse_kinematics(arm, pose, {.all = true, .every_turn = true});
    testing::expect_solved(arm, pose, Task::spatial(), every);
    EXPECT_EQ(every.solutions.size(), 64 * postures.size());
    for (std::size_t a = 0; a < every.solutions.size(); ++a) {
      EXPECT_TRUE(holds(arm, postures, every.solutions[a]));
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_GT((every.solutions[a] - every.solutions[b]).norm(), 1e-3);
      }
    }
  }
}

TEST(PieperSolver, AddsNoMultiplesOfTwoPiToPrismaticJoints) {
  Random random;
  std::vector<Joint> joints = built_in("stanford").joints();
  for (Joint& joint : joints) {
    joint.limits.lower = -7;
    joint.limits.upper = 7;
  }
  const Arm arm("wide", joints, built_in("stanford").tool());
  for (int i = 0; i < 20; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const auto postures = inverse_kinematics(arm, pose, {.all = true}).solutions;
    const InverseResult every = inverse_kinematics(arm, pose, {.all = true, .every_turn = true});
    testing::expect_solved(arm, pose, Task::spatial(), every);
    std::size_t expected = 0;
    for (const Configuration& q : postures) {
      std::size_t turns = 1;
      for (const int k : {0, 1, 3, 4, 5}) {
        std::size_t values = 0;
        for (int turn = -3; turn <= 3; ++turn) values += std::abs(q[k] + 2 * pi * turn) <= 7;
        turns *= values;
      }
      expected += turns;
    }
    EXPECT_EQ(every.solutions.size(), expected);
    for (const Configuration& q : every.solutions) EXPECT_TRUE(holds(arm, postures, q));
  }
}

}  // namespace
}  // namespace beeline::internal
