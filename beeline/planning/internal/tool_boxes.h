#pragma once

#include <Eigen/Geometry>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Boxes around the positions of the tool at consecutive samples, in blocks of 8, 64, 512 and so on
/// samples. They find the samples near a position without a look at all others. Positions count as
/// far as the task constrains them in the axes of the world.
class ToolBoxes {
 public:
  ToolBoxes(const std::vector<Pose>& tool, const Task& task);

  /// Returns the first sample from `first` on between which and its neighbours the tool may be
  /// within a distance of a position; the number of samples if there is none. Between two samples
  /// the tool is hardly farther from the nearer one than they are from each other.
  std::size_t next_near(const Vector3& position, double distance, std::size_t first) const;

 private:
  using Box = Eigen::AlignedBox3d;

  Vector3 constrained(const Vector3& position) const;

  Vector3 counts_ = Vector3::Zero();           ///< 1 for each axis that the task constrains, else 0
  std::vector<std::vector<Box>> levels_ = {};  ///< of the samples, then of blocks of them
};

}  // namespace beeline::internal
