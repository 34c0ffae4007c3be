#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Boxes in a row, in blocks of 8, 64, 512 and so on. They find the boxes near a point without a
/// look at all others.
class BoxBlocks {
 public:
  using Box = Eigen::AlignedBox3d;

  explicit BoxBlocks(std::vector<Box> boxes);

  /// Returns the first box from `first` on within a distance of a point; the number of boxes if
  /// there is none.
  std::size_t next_near(const Vector3& point, double distance, std::size_t first) const;

 private:
  std::vector<std::vector<Box>> levels_ = {};  ///< the boxes, then boxes around blocks of them
};

}  // namespace beeline::internal
