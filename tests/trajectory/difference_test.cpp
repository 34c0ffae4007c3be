#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

Trajectory random_way(testing::Random& random, const Arm& arm, int samples) {
  Trajectory way{arm.joint_names(), {}, {}, {}, {}};
  double t = random.uniform(-5, 5);
  for (int i = 0; i < samples; ++i) {
    way.times.push_back(t += random.uniform(0.01, 0.2));
    way.positions.push_back(random.configuration(arm));
  }
  return way;
}

TEST(Difference, IsNothingBetweenARecordingAndItselfLater) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Trajectory way = random_way(random, arm, 20);
  Trajectory later = way;
  for (double& t : later.times) t += 100;
  const TrajectoryDifference apart = difference(arm, way, later);
  for (const JointDifference& joint : apart.joints) {
    EXPECT_LT(joint.largest, 1e-9);
    EXPECT_LT(joint.rms, 1e-9);
  }
  EXPECT_LT(apart.largest_position, 1e-9);
  EXPECT_NEAR(apart.longer, 0, 1e-12);
  EXPECT_NEAR(apart.overlap, way.times.back() - way.times.front(), 1e-12);
}

TEST(Difference, IsWhatDenseSamplingShows) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int run = 0; run < 50; ++run) {
    const Trajectory a = random_way(random, arm, random.integer(1, 15));
    const Trajectory b = random_way(random, arm, random.integer(1, 15));
    const TrajectoryDifference apart = difference(arm, a, b);
    constexpr int looks = 4000;
    Configuration largest = Configuration::Zero(6), squares = Configuration::Zero(6);
    for (int i = 0; i <= looks; ++i) {
      const double t = apart.overlap * i / looks;
      const Configuration q =
          (sample(b, b.times.front() + t).position - sample(a, a.times.front() + t).position)
              .cwiseAbs();
      largest = largest.cwiseMax(q);
      squares += q.cwiseAbs2() / (looks + 1);
    }
    for (int k = 0; k < 6; ++k) {
      const JointDifference& joint = apart.joints[k];
      ASSERT_GE(joint.largest, largest[k] - 1e-9);
      ASSERT_LE(joint.largest, largest[k] + 0.1);
      ASSERT_NEAR(joint.rms, std::sqrt(squares[k]), 0.01 + 0.01 * joint.rms);
    }
  }
}

TEST(Difference, RefusesWhatDoesNotFit) {
  const Arm ur5 = built_in("ur5");
  const Trajectory still = at_rest(ur5, Configuration::Zero(6));
  EXPECT_REFUSED(difference(built_in("panda"), still, still), "panda");
  EXPECT_REFUSED(difference(ur5, still, Trajectory{ur5.joint_names(), {}, {}, {}, {}}),
                 "the second trajectory has no samples");
}

}  // namespace
}  // namespace beeline
