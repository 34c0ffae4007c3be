#include <gtest/gtest.h>

#include <beeline/collision/internal/box_gaps.h>
#include <beeline/collision/internal/separation.h>

#include <tests/collision/body_over_tube.h>
#include <tests/collision/wide.h>

namespace beeline {

using namespace internal;

namespace {

using testing::BodyOverTube;
using testing::Random;
using testing::Wide;
using testing::WideVector;

/// Different indices of the boxes, in random order: 1, 7 or 8 of them.
std::vector<std::uint32_t> random_indices(Random& random, std::uint32_t boxes) {
  constexpr std::size_t counts[] = {1, 7, boxes_at_once};
  std::vector<std::uint32_t> indices(boxes);
  for (std::uint32_t k = 0; k < boxes; ++k) {
    indices[k] = k;
    std::swap(indices[k], indices[static_cast<std::size_t>(random.integer(0, int(k)))]);
  }
  indices.resize(counts[random.integer(0, 2)]);
  return indices;
}

Vector3 random_half_extents(Random& random, double size) {
  return Vector3::NullaryExpr([&] { return random.integer(0, 2) * random.uniform(0, size); });
}

/// A capsule on the last link of an arm moves over a tube with slack.
TEST(BoxGaps, AreAtMostTheDistancesOverTheTube) {
  Random random;
  for (int i = 0; i < testing::cases(1500); ++i) {
    const BodyOverTube over(random, false);
    std::vector<AlignedBox> boxes(20);
    BoxRows rows;
    for (AlignedBox& box : boxes) {
      box = {5 * random.uniform(0, 1) * random.direction(), random_half_extents(random, 1)};
      rows.add(box);
    }
    const std::vector<std::uint32_t> indices = random_indices(random, 20);
    std::array<double, boxes_at_once> gaps, single;
    box_gaps(over.capsule, rows, indices, gaps);
    for (std::size_t j = 0; j < indices.size(); ++j) {
      box_gaps(over.capsule, rows, {&indices[j], 1}, single);
      EXPECT_EQ(gaps[j], single[0]) << j << " of " << indices.size();
    }
    for (int k = -4; k <= 4; ++k) {
      const ChainMotion still = over.at(k / 4.0, random);
      const ConvexBody at = in_world(still, {over.body, over.last});
      for (std::size_t j = 0; j < indices.size(); ++j) {
        const AlignedBox& box = boxes[indices[j]];
        const Shape obstacle{Box{2 * box.half_extents}, make_pose(box.centre)};
        EXPECT_LE(gaps[j], separation(at, convex_body(obstacle)).upper + 1e-12)
            << j << " of " << indices.size();
      }
    }
  }
}

/// The distance of a point at the origin, which is not rounded itself, without any tolerance.
TEST(BoxGaps, AreRoundedDown) {
  if (!testing::has_wide) GTEST_SKIP() << "long double has no more digits than double";
  Random random;
  for (int i = 0; i < testing::cases(5000); ++i) {
    std::vector<AlignedBox> boxes(12);
    BoxRows rows;
    for (AlignedBox& box : boxes) {
      box.half_extents = random_half_extents(random, std::pow(10, random.uniform(-6, 1)));
      box.centre = std::pow(10, random.uniform(-5, 5)) * random.direction();
      rows.add(box);
    }
    const std::vector<std::uint32_t> indices = random_indices(random, 12);
    std::array<double, boxes_at_once> gaps;
    box_gaps(MovingCapsule(), rows, indices, gaps);
    for (std::size_t j = 0; j < indices.size(); ++j) {
      const AlignedBox& box = boxes[indices[j]];
      const WideVector beyond = box.centre.cast<Wide>().cwiseAbs() - box.half_extents.cast<Wide>();
      const Wide distance = std::sqrt(beyond.cwiseMax(Wide(0)).squaredNorm());
      EXPECT_LE(Wide(gaps[j]), distance) << "case " << i << ", " << j << " of " << indices.size();
      if (distance == 0) continue;
      const double magnitude = box.centre.cwiseAbs().sum() + box.half_extents.sum();
      EXPECT_GE(Wide(gaps[j]), distance - 1e-14 * magnitude);
    }
  }
}

}  // namespace
}  // namespace beeline
