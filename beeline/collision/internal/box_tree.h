#pragma once

#include <cstdint>
#include <vector>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// A box with edges along the axes.
struct AlignedBox {
  Vector3 centre = Vector3::Zero(), half_extents = Vector3::Zero();
};

/// Returns the smallest such box around a body, rounded outwards.
AlignedBox box_around(const ConvexBody& body);

/// Boxes as one array of numbers, from which the lanes of box_gaps() gather: a row of `width`
/// numbers for each box.
class BoxRows {
 public:
  /// Columns of a row: the box, and the rounding of its support values for a unit direction, m.
  enum Column : std::uint8_t { centre = 0, half_extents = 3, rounding = 6, width = 8 };

  void add(const AlignedBox& box);
  const double* data() const { return numbers_.data(); }
  double rounding_of(std::uint32_t box) const { return numbers_[width * box + rounding]; }

 private:
  std::vector<double> numbers_;
};

/// A binary tree of boxes around bodies. Node 0 is the root.
class BoxTree {
 public:
  struct Node {
    AlignedBox box;           ///< around all bodies below the node
    double size = 0;          ///< half the diagonal of the box, m
    double clearance = 0;     ///< the largest clearance of these bodies, m
    std::uint32_t body = 0;   ///< index of the body, if the node is a leaf
    std::uint32_t right = 0;  ///< index of the right child (the left one is the next node); 0: leaf
  };

  BoxTree() = default;
  /// The bodies have finite bounds; `clearances` has a number for each.
  BoxTree(const std::vector<ConvexBody>& bodies, const std::vector<double>& clearances);

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  const BoxRows& boxes() const { return boxes_; }  ///< the boxes of the nodes

 private:
  struct Item {
    AlignedBox box;
    double clearance = 0;
    std::uint32_t body = 0;
  };
  std::uint32_t add(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  BoxRows boxes_;
};

}  // namespace beeline::internal
