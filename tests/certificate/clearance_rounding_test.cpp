#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/kinematics/forward.h>

#include <tests/certificate/random_motion.h>
#include <tests/collision/wide.h>
#include <tests/random_arm.h>

namespace beeline {
namespace {

using testing::Random;
using testing::random_interpolation;
using testing::random_motion;
using testing::Wide;
using testing::WideVector;

/// The proved distance of two spheres is at most the true one at all samples of the motion, which
/// is computed in more digits.
TEST(ClearanceRounding, IsOutwardsAtAllOffsetsAndSizes) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  int proved = 0;
  for (int i = 0; i < testing::cases(2'000); ++i) {
    const double offset = random.integer(0, 1) == 0 ? 0 : std::pow(10, random.uniform(0, 5));
    const Pose mount = make_pose(offset * random.direction(), random.rotation());
    const Arm arm = with_mount(testing::random_arm(random, random.integer(1, 6), 4), mount);
    const Trajectory motion = random_motion(random, arm, random_interpolation(random),
                                            random.integer(1, 3), random.uniform(0, 0.01));
    const std::size_t last = arm.joints().size();
    const double size = std::pow(10, random.uniform(-6, -1));
    const Sphere sphere{size};
    Shape ball{sphere, link_poses(arm, motion.positions.front())[last]};
    const double gap = size * random.uniform(0.01, 3);
    ball.pose.translation() += (2 * size + gap) * random.direction();
    const CollisionModel model(arm, {{"tip", last, {{sphere}}}}, {.obstacles = {{"ball", {ball}}}},
                               {.clearance = gap * std::pow(10, random.uniform(-3, 0))});
    const ClearanceProof proof =
        prove_clearance(model, motion, {.closest = random.integer(0, 1) == 0});
    if (!proof) continue;
    ++proved;
    for (const Configuration& q : motion.positions) {
      const WideVector tip = testing::wide_link_poses(arm, q)[last].translation;
      const WideVector between =
          tip - (ball.pose.translation().cast<Wide>() - arm.base().translation().cast<Wide>());
      EXPECT_LE(Wide(proof.least_distance), std::sqrt(between.squaredNorm()) - 2 * Wide(size))
          << number(size) << " m at " << number(offset) << " m, case " << i;
    }
  }
  EXPECT_GT(proved, testing::cases(2'000) / 10);
}

}  // namespace
}  // namespace beeline
