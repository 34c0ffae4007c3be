#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/model/catalog.h>

#include <tests/allocations.h>
#include <tests/certificate/raised_clearance.h>
#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/random_arm.h>

namespace beeline {
namespace {

/// A thread that has proved a motion proves it again without allocations, whatever it proved
/// before: coarse or with many parts, and for arms with joints that slide.
TEST(Clearance, DoesNotAllocateAgain) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted on this platform";
#endif
  testing::Random random;
  std::size_t most_parts = 0;
  int proved = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Arm arm = i % 2 == 0 ? built_in("panda") : testing::random_arm(random, 6, 4);
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.03),
                               testing::random_scene(random, arm, 30, 0.05, 1),
                               {.self_collision = i % 4 < 2});
    const Trajectory motion = testing::random_motion(random, arm, Interpolation::quintic, 8, 0.05);
    const ClearanceProof first = prove_clearance(model, motion, {.closest = true});
    if (!first || std::isinf(first.least_distance)) continue;
    // Close to the closest approach, many parts are needed.
    const double found = first.pair.upper - first.pair.clearance;
    for (const double beyond : {0.0, 0.999 * found}) {
      const ClearanceProof before = testing::proof_beyond(model, motion, beyond);
      const long count = allocations;
      const ClearanceProof again = beyond > 0 ? testing::proof_beyond(model, motion, beyond)
                                              : prove_clearance(model, motion);
      if (!again) continue;
      EXPECT_EQ(allocations, count) << again.parts << " parts, case " << i;
      EXPECT_EQ(again.parts, before.parts);
      most_parts = std::max(most_parts, again.parts);
      ++proved;
    }
  }
  EXPECT_GT(most_parts, 60U);
  EXPECT_GT(proved, testing::cases(60) / 4);
}

}  // namespace
}  // namespace beeline
