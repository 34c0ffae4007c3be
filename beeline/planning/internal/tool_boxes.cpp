#include <algorithm>

#include <beeline/planning/internal/tool_boxes.h>

namespace beeline::internal {
namespace {

constexpr std::size_t block = 8;  // boxes in a box of the next level

}  // namespace

ToolBoxes::ToolBoxes(const std::vector<Pose>& tool, const Task& task) {
  if (task.frame == Frame::base || task.positions() == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (task.rows[i]) counts_[static_cast<Eigen::Index>(i)] = 1;
    }
  }
  std::vector<Box> samples;
  for (std::size_t k = 0; k < tool.size(); ++k) {
    const Vector3 here = constrained(tool[k].translation());
    double step = 0;
    if (k > 0) step = (constrained(tool[k - 1].translation()) - here).norm();
    if (k + 1 < tool.size()) {
      step = std::max(step, (constrained(tool[k + 1].translation()) - here).norm());
    }
    samples.emplace_back(here - Vector3::Constant(step), here + Vector3::Constant(step));
  }
  levels_.push_back(std::move(samples));
  while (levels_.back().size() > block) {
    const std::vector<Box>& lower = levels_.back();
    std::vector<Box> boxes((lower.size() + block - 1) / block);
    for (std::size_t i = 0; i < lower.size(); ++i) boxes[i / block].extend(lower[i]);
    levels_.push_back(std::move(boxes));
  }
}

Vector3 ToolBoxes::constrained(const Vector3& position) const {
  return counts_.cwiseProduct(position);
}

std::size_t ToolBoxes::next_near(const Vector3& position, double distance,
                                 std::size_t first) const {
  const Vector3 here = constrained(position);
  const auto is_near = [&](std::size_t level, std::size_t i) {
    return levels_[level][i].exteriorDistance(here) <= distance;
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
