#include <algorithm>

#include <beeline/planning/internal/tool_boxes.h>

namespace beeline::internal {
namespace {

std::vector<BoxBlocks::Box> boxes_of(const std::vector<Pose>& tool, const Task& task) {
  std::vector<BoxBlocks::Box> samples;
  for (std::size_t k = 0; k < tool.size(); ++k) {
    const Vector3 here = constrained(task, tool[k].translation());
    double step = 0;
    if (k > 0) step = (constrained(task, tool[k - 1].translation()) - here).norm();
    if (k + 1 < tool.size()) {
      step = std::max(step, (constrained(task, tool[k + 1].translation()) - here).norm());
    }
    samples.emplace_back(here - Vector3::Constant(step), here + Vector3::Constant(step));
  }
  return samples;
}

}  // namespace

Vector3 constrained(const Task& task, const Vector3& position) {
  Vector3 counted = Vector3::Zero();
  if (task.frame != Frame::base && task.positions() != 3) return counted;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    if (task.rows[i]) counted[axis] = position[axis];
  }
  return counted;
}

ToolBoxes::ToolBoxes(const std::vector<Pose>& tool, const Task& task)
    : task_(task), boxes_(boxes_of(tool, task)) {}

std::size_t ToolBoxes::next_near(const Vector3& position, double distance,
                                 std::size_t first) const {
  return boxes_.next_near(constrained(task_, position), distance, first);
}

}  // namespace beeline::internal
