// RaghavanRothSolver::Result::complete: what it promises, and that most results have it.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/analytic/raghavan_roth_newton.h>
#include <beeline/inverse/analytic/raghavan_roth_solutions.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/so3.h>

#include <tests/inverse/families.h>

namespace beeline::internal {
namespace {

using testing::cases;
using testing::Random;

using std::numbers::pi;

Configuration any_angles(Random& random) {
  Configuration q(6);
  for (double& each : q) each = random.uniform(-pi, pi);
  return q;
}

/// Solves for the poses of configurations of one arm.
struct Solver {
  explicit Solver(const Arm& its_arm)
      : arm(its_arm), solver(chain_of(arm), choose_eliminations(chain_of(arm))) {}

  RaghavanRothSolver::Result solve(const Configuration& from) {
    return solver.solve(forward_kinematics(arm, from), q);
  }

  double determinant(const Configuration& at) const {
    return jacobian(arm, at, Frame::base).determinant();
  }

  /// Checks a complete result: the configuration is a solution, and the signs of the determinants
  /// have the sum zero if none is zero to rounding.
  void check_if_complete(const Configuration& from) {
    const RaghavanRothSolver::Result result = solve(from);
    if (!result.complete) return;
    bool found = false, regular = true;
    int balance = 0;
    for (int k = 0; k < result.count; ++k) {
      double off = 0;
      for (int i = 0; i < 6; ++i) off = std::max(off, std::abs(angle_difference(q(i, k), from[i])));
      found |= off < 1e-5;
      const double at = determinant(q.col(k));
      regular &= std::abs(at) > 1e-7;
      balance += at > 0 ? 1 : -1;
    }
    EXPECT_TRUE(found) << from.transpose() << ": " << result.count;
    EXPECT_TRUE(!regular || balance == 0) << from.transpose();
  }

  Arm arm;
  RaghavanRothSolver solver;
  Eigen::Matrix<double, 6, Eigen::Dynamic> q{6, RaghavanRothSolver::max_solutions};
};

Configuration on_lattice(const std::array<int, 6>& eighths) {
  Configuration q(6);
  for (int i = 0; i < 6; ++i) q[i] = eighths[static_cast<std::size_t>(i)] * pi / 4;
  return q;
}

// There many zeros of the determinants are double or more.
TEST(RaghavanRothCompleteness, NothingIsMissedAtRightAngles) {
  Random random;
  Solver crx(built_in("crx10ia"));
  for (const std::array<int, 6>& eighths : {std::array{3, 0, -1, 1, 0, 3},
                                            {4, 4, -1, 1, 0, 4},
                                            {0, -4, -3, 3, 2, 4},
                                            {3, 4, -1, -1, 2, -4},
                                            {-1, -4, 1, -1, 0, 4},
                                            {0, -4, 0, -3, 3, 2},
                                            {3, 4, 0, -3, 2, 0}}) {
    crx.check_if_complete(on_lattice(eighths));
  }
  for (int i = 0; i < cases(6000); ++i) {
    std::array<int, 6> eighths;
    for (int& each : eighths) each = random.integer(-3, 4);
    crx.check_if_complete(on_lattice(eighths));
  }
}

// Each of these had a result that was called complete and was not.
TEST(RaghavanRothCompleteness, NothingIsMissedBesideSingularities) {
  const Arm arm = built_in("crx10ia");
  Solver crx(arm);
  for (const std::array<double, 6>& at :
       {std::array{1.57079622679, 1e-6, -2.35519449019, 0.785397163397, -1.57079631679,
                   2.35619349019},
        {-1e-9, 1e-5, -0.484603436921, -2.2945130692, -1e-5, 1.57079532679},
        {1.08769151953, 1e-7, 1.67909262385, 1.77467878002, 3.14059265359, 0.776701391806},
        {-1.17226019243, -0.072021969723, 0.242338872493, -1.20166543859, -0.00720430953716,
         2.90985894477},
        {0.749465353088, -0.60468764321, 0.178626010692, -2.31630829921, 0.496604965173,
         0.236956048794},
        {-1.72750826246, 0.376906137677, 2.46614659901, -2.60865508026, 0.376831178464,
         1.53899334579},
        {2.92395474229, -2.06905684308, 2.06797672886, -0.965343812373, 0.137737471921,
         -2.62457250714}}) {
    const Configuration from = Eigen::Map<const Configuration>(at.data(), 6);
    crx.check_if_complete(from);
    const InverseResult all =
        inverse_kinematics(arm, forward_kinematics(arm, from),
                           {.all = true, .ignore_limits = true, .max_restarts = 0});
    const bool found =
        std::any_of(all.solutions.begin(), all.solutions.end(),
                    [&](const Configuration& q) { return same_posture(arm, q, from, 1e-5); });
    EXPECT_TRUE(found || !all.complete) << from.transpose();
  }
}

TEST(RaghavanRothCompleteness, MostRandomPosesAreComplete) {
  Random random;
  Solver crx(built_in("crx10ia"));
  const int poses = cases(3000);
  int complete = 0;
  for (int i = 0; i < poses; ++i) {
    const Configuration from = any_angles(random);
    crx.check_if_complete(from);
    complete += crx.solve(from).complete ? 1 : 0;
  }
  EXPECT_GT(complete, 0.93 * poses);
}

TEST(RaghavanRothCompleteness, DoesNotDependOnTheUnitOfLength) {
  Random random;
  Solver metres(built_in("crx10ia"));
  for (const double factor : {1e3, 1e-3}) {
    Solver other(testing::scaled(metres.arm, factor));
    int more = 0;
    const int poses = cases(600);
    for (int i = 0; i < poses; ++i) {
      const Configuration from = any_angles(random);
      const auto a = metres.solve(from), b = other.solve(from);
      EXPECT_EQ(a.count, b.count) << from.transpose();
      more += (b.complete ? 1 : 0) - (a.complete ? 1 : 0);
    }
    EXPECT_LE(std::abs(more), 0.1 * poses + 2);  // rounding chooses the eliminations
  }
}

// Five joints and the choice of the last move the tool by less than clear_error.
TEST(RaghavanRothCompleteness, ACandidateNearASolutionHasASmallError) {
  Random random;
  double largest = 0;
  for (int i = 0; i < cases(3000); ++i) {
    Chain chain = chain_of(built_in("crx10ia"));
    for (Chain::Link& link : chain.links) {
      link.translation *= std::exp(random.uniform(-3, 3));
      link.cos_alpha = std::cos(link.cos_alpha + random.uniform(-3, 3));
      link.sin_alpha = std::sqrt(1 - link.cos_alpha * link.cos_alpha);
    }
    const RevoluteLinks links = revolute_links(chain);
    const Configuration from = any_angles(random);
    Pose goal = Pose::Identity();
    for (int k = 0; k < 6; ++k) goal = goal * link_transform(chain.links[k], from[k]);
    EightConfigurations eight{};
    for (int k = 0; k < 6; ++k) {
      for (int lane = 0; lane < 8; ++lane) {
        eight.q[k][lane] = from[k] + (random.integer(0, 1) == 0 ? -1 : 1) * max_correction;
      }
    }
    newton(links, rigid_motion(goal, links.unit), random.integer(0, 5), 1e-13, eight);
    for (const double error : eight.error) {
      EXPECT_LT(error, clear_error);
      largest = std::max(largest, error);
    }
  }
  EXPECT_GT(largest, 0.2 * clear_error);  // the bound is not far off
}

}  // namespace
}  // namespace beeline::internal
