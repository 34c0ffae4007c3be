#pragma once

#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/planning/internal/box_blocks.h>

namespace beeline::internal {

/// A position as far as a task constrains it in the axes of the world: the other coordinates are 0.
/// Two positions of the tool whose distance the task bounds are at most as far from each other.
Vector3 constrained(const Task& task, const Vector3& position);

/// Boxes around the positions of the tool at consecutive samples, as far as a task constrains them.
class ToolBoxes {
 public:
  ToolBoxes(const std::vector<Pose>& tool, const Task& task);

  /// Returns the first sample from `first` on between which and its neighbours the tool may be
  /// within a distance of a position; the number of samples if there is none. Between two samples
  /// the tool is hardly farther from the nearer one than they are from each other.
  std::size_t next_near(const Vector3& position, double distance, std::size_t first) const;

 private:
  Task task_;
  BoxBlocks boxes_;
};

}  // namespace beeline::internal
