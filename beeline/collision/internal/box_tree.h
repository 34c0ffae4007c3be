#pragma once

#include <cstdint>
#include <vector>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// A box with edges along the axes.
struct AlignedBox {
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
};

/// Returns the smallest such box around a body, rounded outwards.
AlignedBox box_around(const ConvexBody& body);

/// A binary tree of boxes around bodies. Node 0 is the root.
class BoxTree {
 public:
  struct Node {
    AlignedBox box;           ///< around all bodies below the node
    double clearance = 0;     ///< the largest clearance of these bodies, m
    std::uint32_t body = 0;   ///< index of the body, if the node is a leaf
    std::uint32_t right = 0;  ///< index of the right child (the left one is the next node); 0: leaf
  };

  BoxTree() = default;
  /// The bodies have finite bounds; `clearances` has a number for each.
  BoxTree(const std::vector<ConvexBody>& bodies, const std::vector<double>& clearances);

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }

 private:
  struct Item {
    AlignedBox box;
    double clearance = 0;
    std::uint32_t body = 0;
  };
  std::uint32_t add(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
};

}  // namespace beeline::internal
