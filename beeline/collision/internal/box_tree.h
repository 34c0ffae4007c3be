#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// A box with edges along the axes.
struct AlignedBox {
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
};

/// Returns the smallest such box around a body, rounded outwards.
AlignedBox box_around(const ConvexBody& body);

/// A box of the tree as numbers for the lanes of box_gaps().
struct BoxRow {
  std::array<double, 3> centre = {}, half = {};
  double rounding = 0;   ///< of the box's support values for a unit direction, m
  double clearance = 0;  ///< the largest clearance of the bodies in the box, m
};
inline constexpr std::size_t box_row_width = sizeof(BoxRow) / sizeof(double);

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
  std::span<const BoxRow> rows() const { return rows_; }  ///< of the nodes

 private:
  struct Item {
    AlignedBox box;
    double clearance = 0;
    std::uint32_t body = 0;
  };
  std::uint32_t add(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
  std::vector<BoxRow> rows_;
};

}  // namespace beeline::internal
