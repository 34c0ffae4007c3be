#include <Eigen/LU>
#include <gtest/gtest.h>

#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/path/random_line.h>

namespace beeline {
namespace {

using testing::cases;
using testing::Random;

double determinant(const Arm& arm, Configuration q, int k, double value) {
  q[k] = value;
  return jacobian(arm, q).determinant();
}

/// A random configuration at which joint k makes the arm singular; nothing if none was found.
std::optional<Configuration> singular_by(Random& random, const Arm& arm, int k) {
  constexpr int scan = 40, bisections = 60;
  Configuration q = testing::inner_configuration(random, arm);
  const double low = std::max(arm.limits(k).lower, -3.1), high = std::min(arm.limits(k).upper, 3.1);
  const int first = random.integer(0, scan - 1);
  for (int i = 0; i < scan; ++i) {
    const double step = (high - low) / scan;
    double a = low + (first + i) % scan * step, b = a + step;
    const double at_a = determinant(arm, q, k, a);
    if (!(at_a * determinant(arm, q, k, b) < 0)) continue;
    for (int n = 0; n < bisections; ++n) {
      const double middle = (a + b) / 2;
      (at_a * determinant(arm, q, k, middle) < 0 ? b : a) = middle;
    }
    q[k] = a;
    return q;
  }
  return {};
}

/// A pose near that of q in a direction in which the arm can move.
Pose reachable_from(Random& random, const Arm& arm, const Configuration& q) {
  Configuration rates(arm.dof());
  for (double& rate : rates) rate = random.uniform(-0.2, 0.2);
  const Twist twist = jacobian(arm, q) * rates;
  Pose to = forward_kinematics(arm, q);
  to.translation() += twist.head<3>();
  to.linear() = so3_exp(twist.tail<3>()) * to.linear();
  return to;
}

// A line that can be followed from one of infinitely many configurations at its beginning, or from
// one at which branches meet, is also found without that configuration. Those that are
// tangent to the singular poses may be missed.
TEST(SingularLines, AreFoundWithoutAStartWhereTheyAreFoundWithOne) {
  Random random;
  int found = 0, missed = 0;
  for (const char* name : {"puma560", "ur5e", "irb120", "kr6_r900", "gp8"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(18); ++i) {
      const int k = i % 3 == 0 ? 4 : i % 3 == 1 ? 2 : 1;  // wrist, elbow, shoulder
      const auto q = singular_by(random, arm, k);
      if (!q) continue;
      const Pose from = forward_kinematics(arm, *q);
      const Pose to =
          i % 2 == 0 ? testing::nearby_pose(random, arm, from) : reachable_from(random, arm, *q);
      // Motions with very fast joints next to the singularity take long to prove.
      const PathMotionOptions options{.budget = {.max_work = 200'000}};
      const PathMotion with_start = move_in_lines(arm, *q, {to}, options);
      if (!with_start) continue;
      ++found;
      const PathMotion without = move_in_lines(arm, {from, to}, options);
      if (without) continue;
      ++missed;
      std::cout << name << ' ' << q->transpose() << '\n' << without.reason << '\n';
    }
  }
  EXPECT_GT(found, cases(10));
  EXPECT_LE(missed, 1 + found / 50);
}

// Both ends of the line are singular, so that no end determines the branch.
TEST(SingularLines, BetweenTwoSingularPosesAreFound) {
  const Arm arm = built_in("puma560");
  const Configuration wrist{{0.2, 0.6, -0.9, 0.4, 0, 0.3}};
  const Pose from = forward_kinematics(arm, wrist);
  Pose to = from;
  to.translation() += Vector3(0.05, 0.04, -0.06);
  // The wrist is singular again where the tool's axis is parallel to the forearm's.
  const PathMotion there = move_in_lines(arm, {from, to});
  ASSERT_TRUE(there) << there.reason;
  Configuration end = there.trajectory.positions.back();
  end[4] = 0;
  const Pose singular = forward_kinematics(arm, end);
  const PathMotion motion = move_in_lines(arm, {from, singular});
  EXPECT_TRUE(motion) << motion.reason;
  const PathMotion again = move_in_lines(arm, {from, singular, from, singular});
  EXPECT_TRUE(again) << again.reason;
}

}  // namespace
}  // namespace beeline
