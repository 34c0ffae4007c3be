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

/// A joint slides from -size to its peak near 0 and back: the parts about the peak are small, and
/// the rounding of their coefficients is as large as the rounding of the whole.
TEST(ClearanceRounding, IncludesTheWholeMotionAboutAPeak) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  Joint joint;
  joint.name = "slide";
  joint.screw = translation_screw(Vector3::UnitX());
  const Arm arm("slide", {joint}, Pose::Identity(), Pose::Identity());
  for (int i = 0; i < testing::cases(300); ++i) {
    const double size = std::pow(10, random.uniform(0, 6)), clearance = 1e-11;
    const auto about = [&](double value) { return value * (1 + random.uniform(-1e-9, 1e-9)); };
    const double p0 = -size, p1 = about(-size), v0 = about(4 * size), v1 = about(-4 * size);
    const Trajectory motion{arm.joint_names(),
                            {0, 1},
                            {Configuration::Constant(1, p0), Configuration::Constant(1, p1)},
                            {Configuration::Constant(1, v0), Configuration::Constant(1, v1)},
                            {}};
    const Wide c2 = 3 * (Wide(p1) - p0) - 2 * Wide(v0) - v1;
    const Wide c3 = 2 * (Wide(p0) - p1) + Wide(v0) + v1;
    Wide u = 0.5;
    for (int k = 0; k < 8; ++k) u -= ((3 * c3 * u + 2 * c2) * u + v0) / (6 * c3 * u + 2 * c2);
    const Wide peak = ((c3 * u + c2) * u + v0) * u + p0;
    Shape point{Sphere{0}};
    point.pose.translation().x() = static_cast<double>(peak + clearance * random.uniform(0, 1));
    if (Wide(point.pose.translation().x()) - peak >= clearance) continue;
    const CollisionModel model(arm, {{"tip", 1, {{Sphere{0}}}}},
                               {.obstacles = {{"point", {point}}}}, {.clearance = clearance});
    EXPECT_FALSE(prove_clearance(model, motion)) << number(size) << " m, case " << i;
  }
}

}  // namespace
}  // namespace beeline
