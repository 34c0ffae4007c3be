#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/model/catalog.h>

#include <tests/allocations.h>
#include <tests/certificate/raised_clearance.h>
#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>

namespace beeline {
namespace {

/// A motion that grazes its clearance is divided into more parts for a finer resolution. Their
/// number must not show in the allocations, which are of the preparation and of deeper levels.
TEST(Clearance, DoesNotAllocateForItsParts) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted on this platform";
#endif
  testing::Random random;
  const Arm arm = built_in("panda");
  long most = 0;
  std::size_t most_parts = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.03),
                               testing::random_scene(random, arm, 30, 0.05, 1),
                               {.self_collision = false});
    const Trajectory motion = testing::random_motion(random, arm, Interpolation::quintic, 8, 0.05);
    const ClearanceProof first = prove_clearance(model, motion, {.closest = true});
    if (!first) continue;
    // Close to the closest approach, many parts are needed.
    const auto counted = [&](double beyond) {
      const long before = allocations;
      const ClearanceProof proof = testing::proof_beyond(model, motion, beyond);
      most_parts = std::max(most_parts, proof.parts);
      return std::pair(allocations - before, proof);
    };
    const double found = first.pair.upper - first.pair.clearance;
    const auto [coarse, few] = counted(0);
    const auto [fine, many] = counted(0.999 * found);
    if (!few || !many || many.parts < few.parts + 20) continue;
    most = std::max(most, fine - coarse);
  }
  EXPECT_GT(most_parts, 60U);
  EXPECT_LE(most, 60);
}

}  // namespace
}  // namespace beeline
