#include <beeline/planning/internal/box_blocks.h>

namespace beeline::internal {
namespace {

constexpr std::size_t block = 8;  // boxes in a box of the next level

}  // namespace

BoxBlocks::BoxBlocks(std::vector<Box> boxes) {
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > block) {
    const std::vector<Box>& lower = levels_.back();
    std::vector<Box> larger((lower.size() + block - 1) / block);
    for (std::size_t i = 0; i < lower.size(); ++i) larger[i / block].extend(lower[i]);
    levels_.push_back(std::move(larger));
  }
}

std::size_t BoxBlocks::next_near(const Vector3& point, double distance, std::size_t first) const {
  const auto is_near = [&](std::size_t level, std::size_t i) {
    return levels_[level][i].exteriorDistance(point) <= distance;
  };
  const std::size_t count = levels_.front().size();
  for (std::size_t k = first; k < count;) {
    if (is_near(0, k)) return k;
    std::size_t skipped = 1;
    for (std::size_t level = 1, size = block; level < levels_.size(); ++level, size *= block) {
      if (k % size != 0 || is_near(level, k / size)) break;
      skipped = size;
    }
    k += skipped;
  }
  return count;
}

}  // namespace beeline::internal
