#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/timing/internal/retimed_paths.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using beeline::testing::cases;
using beeline::testing::Random;

TEST(IntervalsOutsideLimits, AreWhereAJointIsOutsideBetweenTwoSamples) {
  Random random;
  const Arm arm = built_in("panda");
  int outside = 0, inside = 0;
  for (int i = 0; i < cases(200); ++i) {
    Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
    for (int k = 0; k < 4; ++k) {
      motion.times.push_back(k);
      motion.positions.push_back(random.configuration(arm));
      motion.velocities.push_back(Configuration::Random(arm.dof()) * 3);
    }
    const std::vector<std::size_t> found = intervals_outside_limits(arm, motion);
    for (std::size_t k = 0; k + 1 < motion.size(); ++k) {
      double excess = -Limits::none;
      for (int part = 0; part <= 200; ++part) {
        const Configuration q = sample(motion, static_cast<double>(k) + part / 200.0).position;
        for (int j = 0; j < arm.dof(); ++j) {
          excess = std::max({excess, q[j] - arm.limits(j).upper, arm.limits(j).lower - q[j]});
        }
      }
      if (std::abs(excess) < 1e-3) continue;
      const bool is_found = std::find(found.begin(), found.end(), k) != found.end();
      EXPECT_EQ(is_found, excess > 0) << excess;
      ++(is_found ? outside : inside);
    }
  }
  EXPECT_GT(outside, 0);
  EXPECT_GT(inside, 0);
}

TEST(IntervalsOutsideLimits, AllowTheRoundingOfTheirEnds) {
  const Arm arm = built_in("panda");
  for (const double excess : {0.5 * position_slack, 2 * position_slack}) {
    Configuration q = middle_configuration(arm);
    q[1] = arm.limits(1).upper + excess;
    q[2] = arm.limits(2).lower - excess;
    const Configuration rest = 0 * q;
    const Trajectory motion{arm.joint_names(), {0, 1}, {q, q}, {rest, rest}, {}};
    EXPECT_EQ(intervals_outside_limits(arm, motion).empty(), excess < position_slack);
    EXPECT_EQ(limit_violations(arm, q).empty(), excess < position_slack);
  }
}

}  // namespace
}  // namespace beeline::internal
