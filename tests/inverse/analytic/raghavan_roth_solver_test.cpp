#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include <beeline/error.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using testing::cases;
using testing::example_size;
using testing::Random;

using std::numbers::pi;
using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Rows = std::array<std::array<double, 3>, 6>;  // a, alpha, d, standard

Arm arm_of(const Rows& rows, const Pose& tool = Pose::Identity(),
           const Pose& base = Pose::Identity()) {
  std::vector<Joint> joints;
  for (const auto& [a, alpha, d] : rows) {
    joints.push_back(dh_joint({.a = a, .alpha = alpha, .d = d}, DhConvention::standard));
    joints.back().name = "j" + std::to_string(joints.size());
  }
  return {"six", joints, tool, base};
}

Rows random_rows(Random& random) {
  Rows rows;
  for (auto& row : rows) {
    row = {random.uniform(-0.5, 0.5), random.uniform(-3, 3), random.uniform(-0.5, 0.5)};
  }
  return rows;
}

const Rows ur5{{{0, pi / 2, 0.089159},
                {-0.425, 0, 0},
                {-0.39225, 0, 0},
                {0, pi / 2, 0.10915},
                {0, -pi / 2, 0.09465},
                {0, 0, 0.0823}}};

/// A wrist like the one of Kinova's Jaco: skew axes with 55 degrees between them.
Rows slanted_wrist() {
  const double slant = 11 * pi / 36, half = 0.0741 * std::sin(slant / 2) / std::sin(slant);
  return {{{0, pi / 2, 0.2755},
           {0.41, pi, 0},
           {0, pi / 2, -0.0098},
           {0, slant, -0.2073 - half},
           {0, slant, -2 * half},
           {0, pi, -0.16 - half}}};
}

Rows disturbed(Random& random, Rows rows, double by) {
  for (auto& row : rows) {
    for (double& each : row) each += random.uniform(-by, by);
  }
  return rows;
}

Configuration anywhere(Random& random) {
  Configuration q(6);
  for (double& each : q) each = random.uniform(-pi, pi);
  return q;
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double most = 0;
  for (int i = 0; i < 6; ++i) most = std::max(most, std::abs(angle_difference(a[i], b[i])));
  return most;
}

bool holds(const Columns& q, int count, const Configuration& one, double tolerance = 1e-5) {
  for (int k = 0; k < count; ++k) {
    if (distance(q.col(k), one) < tolerance) return true;
  }
  return false;
}

/// Checks that every solution reaches the pose, is in [-pi, pi], and differs from the others.
void expect_solutions(const Arm& arm, const Pose& pose, const Columns& q, int count) {
  for (int k = 0; k < count; ++k) {
    const Pose reached = forward_kinematics(arm, q.col(k));
    EXPECT_LT((reached.matrix() - pose.matrix()).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LE(q.col(k).cwiseAbs().maxCoeff(), pi);
    EXPECT_FALSE(holds(q, k, q.col(k), 1e-6));
  }
}

RaghavanRothSolver solver_of(const Arm& arm) {
  return {chain_of(arm), choose_eliminations(chain_of(arm))};
}

/// The number of random configurations that are not among the solutions of their pose.
int misses(Random& random, const Arm& arm, const RaghavanRothSolver& solver, int poses) {
  int missed = 0;
  Columns q(6, 16);
  for (int i = 0; i < poses; ++i) {
    const Configuration from = anywhere(random);
    const Pose pose = forward_kinematics(arm, from);
    const int count = solver.solve(pose, q).count;
    expect_solutions(arm, pose, q, count);
    if (!holds(q, count, from)) ++missed;
  }
  return missed;
}

void expect_found(Random& random, const Arm& arm, int poses) {
  const EliminationChoice choice = choose_eliminations(chain_of(arm));
  const RaghavanRothSolver solver(chain_of(arm), choice);
  EXPECT_TRUE(choice.reliable);
  EXPECT_EQ(misses(random, arm, solver, poses), 0);
}

TEST(RaghavanRothSolver, FindsTheConfigurationOfAnyArm) {
  Random random;
  for (int i = 0; i < cases(30); ++i) {
    expect_found(random, arm_of(random_rows(random), random.pose(), random.pose(2)),
                 example_size(300));
  }
}

TEST(RaghavanRothSolver, FindsItWhereTwoAxesIntersectOrAreParallel) {
  Random random;
  for (int joint = 0; joint < 5; ++joint) {
    Rows rows = random_rows(random);
    rows[joint][0] = 0;
    expect_found(random, arm_of(rows), example_size(300));
    rows = random_rows(random);
    rows[joint][1] = 0;
    expect_found(random, arm_of(rows), example_size(300));
  }
}

TEST(RaghavanRothSolver, FindsItWithAxesAtRightAngles) {
  Random random;
  for (int i = 0; i < cases(10); ++i) {
    Rows rows = random_rows(random);
    for (auto& row : rows) row[1] = std::copysign(pi / 2, row[1]);
    expect_found(random, arm_of(rows), 300);
  }
}

TEST(RaghavanRothSolver, FindsItForACalibratedUr5) {
  Random random;
  for (const double by : {1e-2, 1e-4, 1e-6, 1e-8}) {
    for (int i = 0; i < cases(3); ++i)
      expect_found(random, arm_of(disturbed(random, ur5, by)), example_size(300));
  }
}

TEST(RaghavanRothSolver, FindsItForASlantedWrist) {
  Random random;
  expect_found(random, arm_of(slanted_wrist()), example_size(3000));
}

/// An arm like FANUC's CRX: right angles everywhere and an offset in the wrist.
TEST(RaghavanRothSolver, FindsItForAWristWithAnOffset) {
  Random random;
  expect_found(random,
               arm_of({{{0, -pi / 2, 0},
                        {0.54, pi, 0},
                        {0, -pi / 2, 0},
                        {0, pi / 2, -0.54},
                        {0, -pi / 2, 0.15},
                        {0, pi, -0.16}}}),
               cases(3000));
}

// The arm of Manocha & Canny, "Efficient inverse kinematics for general 6R manipulators", 1994.
TEST(RaghavanRothSolver, FindsSixteenSolutions) {
  constexpr double one = pi / 180;
  const Arm arm = arm_of({{{0.3, pi / 2, 0},
                           {1, one, 0},
                           {0, pi / 2, 0.2},
                           {1.5, one, 0},
                           {0, pi / 2, 0},
                           {1.1353, one, 0}}});
  const EliminationChoice choice = choose_eliminations(chain_of(arm));
  const RaghavanRothSolver solver(chain_of(arm), choice);
  EXPECT_TRUE(choice.reliable);
  const Configuration from{{-2.074, 2.120, 0.517, 2.688, 0.178, 3.085}};
  const Pose pose = forward_kinematics(arm, from);
  Columns q(6, 16);
  ASSERT_EQ(solver.solve(pose, q).count, 16);
  expect_solutions(arm, pose, q, 16);
  EXPECT_TRUE(holds(q, 16, from));
}

/// Newton's method on the library's own kinematics, from many starts.
std::vector<Configuration> search(Random& random, const Arm& arm, const Pose& pose, int starts) {
  std::vector<Configuration> found;
  for (int start = 0; start < starts; ++start) {
    Configuration q = anywhere(random);
    for (int step = 0; step < 30; ++step) {
      const Twist error = pose_difference(pose, forward_kinematics(arm, q));
      if (error.norm() < 1e-11) {
        bool known = false;
        for (const Configuration& other : found) known = known || distance(q, other) < 1e-5;
        if (!known) found.push_back(q);
        break;
      }
      const Eigen::VectorXd by = jacobian(arm, q, Frame::base).partialPivLu().solve(error);
      if (!by.allFinite()) break;
      q += by * std::min(1.0, 0.5 / by.cwiseAbs().maxCoeff());
    }
  }
  return found;
}

TEST(RaghavanRothSolver, FindsEverySolutionThatASearchFinds) {
  Random random;
  Columns q(6, 16);
  int found_by_search = 0, found = 0;
  for (int i = 0; i < cases(40); ++i) {
    const Arm arm = arm_of(i % 4 == 0 ? disturbed(random, ur5, 1e-4) : random_rows(random));
    const RaghavanRothSolver solver = solver_of(arm);
    const Pose pose = forward_kinematics(arm, anywhere(random));
    const int count = solver.solve(pose, q).count;
    found += count;
    for (const Configuration& other : search(random, arm, pose, 400)) {
      ++found_by_search;
      EXPECT_TRUE(holds(q, count, other)) << other.transpose();
    }
  }
  EXPECT_GT(found_by_search, 0.9 * found);  // otherwise it proves little
}

TEST(RaghavanRothSolver, SolutionsComeInPairs) {
  Random random;
  Columns q(6, 16);
  for (int i = 0; i < cases(10); ++i) {
    const Arm arm = arm_of(random_rows(random));
    const RaghavanRothSolver solver = solver_of(arm);
    for (int k = 0; k < 200; ++k) {
      const int count = solver.solve(forward_kinematics(arm, anywhere(random)), q).count;
      EXPECT_GE(count, 2);
      EXPECT_EQ(count % 2, 0);
    }
  }
}

// At a singular configuration two solutions coincide.
TEST(RaghavanRothSolver, FindsDoubleSolutions) {
  Random random;
  Columns q(6, 16);
  const int arms = std::max(20, cases(200));
  int tried = 0;
  for (int i = 0; i < arms; ++i) {
    const Arm arm = arm_of(random_rows(random));
    // Bisection of joint 3 to a zero of the Jacobian's determinant.
    Configuration from = anywhere(random), to = from;
    to[2] = random.uniform(-pi, pi);
    const auto determinant = [&](const Configuration& at) {
      return jacobian(arm, at, Frame::base).determinant();
    };
    const bool sign = determinant(from) > 0;
    if (sign == (determinant(to) > 0)) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const Configuration middle = (from + to) / 2;
      (sign == (determinant(middle) > 0) ? from : to) = middle;
    }
    ++tried;
    const Pose pose = forward_kinematics(arm, from);
    const RaghavanRothSolver solver = solver_of(arm);
    const int count = solver.solve(pose, q).count;
    expect_solutions(arm, pose, q, count);
    EXPECT_TRUE(holds(q, count, from, 1e-4)) << from.transpose();
  }
  EXPECT_GT(tried, arms * 3 / 20);
}

TEST(RaghavanRothSolver, FindsNothingOutOfReach) {
  Random random;
  Columns q(6, 16);
  for (int i = 0; i < example_size(20); ++i) {
    const Arm arm = arm_of(random_rows(random));
    const RaghavanRothSolver solver = solver_of(arm);
    Pose pose = random.pose();
    pose.translation() = arm.reach().centre + 1.01 * arm.reach().radius * random.direction();
    const auto result = solver.solve(pose, q);
    EXPECT_EQ(result.count, 0);
  }
}

TEST(RaghavanRothSolver, RefusesOtherArms) {
  EXPECT_THROW(choose_eliminations(chain_of(built_in("panda"))), Error);
  EXPECT_THROW(choose_eliminations(chain_of(built_in("stanford"))), Error);
  Columns few(6, 15);
  const Arm arm = arm_of(ur5);
  EXPECT_THROW(solver_of(arm).solve(Pose::Identity(), few), Error);
}

}  // namespace
}  // namespace beeline::internal
