#pragma once

#include <cstdint>
#include <vector>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// A binary tree of boxes around points: each node has a box, and either two children or a few
/// points. Children follow their parent.
class PointTree {
 public:
  struct Node {
    Vector3 lower, upper;
    std::uint32_t begin = 0, end = 0;  ///< its points: places in points()
    std::uint32_t second = 0;          ///< the second child; the first follows the node. 0: a leaf
  };

  /// Requires a point at least.
  explicit PointTree(std::vector<Vector3> points);

  /// The points; the points of a node are in succession.
  const std::vector<Vector3>& points() const { return points_; }
  const Node& node(std::uint32_t index) const { return nodes_[index]; }  ///< 0 is the root

  std::size_t node_count() const { return nodes_.size(); }

  /// Returns the place of a point that is furthest in the direction.
  std::uint32_t furthest(const Vector3& direction) const;

 private:
  void add(std::uint32_t begin, std::uint32_t end);

  std::vector<Vector3> points_;
  std::vector<Node> nodes_;
};

}  // namespace beeline::internal
