#include <algorithm>
#include <limits>
#include <utility>

#include <beeline/collision/internal/point_tree.h>

namespace beeline::internal {
namespace {

constexpr std::uint32_t leaf_size = 16;

/// The maximum of direction . x over a box.
double highest_along(const PointTree::Node& node, const Vector3& direction) {
  return direction.cwiseProduct(node.lower).cwiseMax(direction.cwiseProduct(node.upper)).sum();
}

}  // namespace

PointTree::PointTree(std::vector<Vector3> points) : points_(std::move(points)) {
  add(0, static_cast<std::uint32_t>(points_.size()));
}

/// Adds the node of a range of points and, below it, its children. Halves are equal, so that the
/// tree is flat whatever the points are.
void PointTree::add(std::uint32_t begin, std::uint32_t end) {
  const auto first = points_.begin() + begin, last = points_.begin() + end;
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{.lower = *first, .upper = *first, .begin = begin, .end = end};
  for (auto at = first; at != last; ++at) {
    node.lower = node.lower.cwiseMin(*at);
    node.upper = node.upper.cwiseMax(*at);
  }
  nodes_.push_back(node);
  if (end - begin <= leaf_size) return;
  Eigen::Index axis = 0;
  (node.upper - node.lower).maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(first, points_.begin() + middle, last,
                   [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; });
  add(begin, middle);
  nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
  add(middle, end);
}

std::uint32_t PointTree::furthest(const Vector3& direction) const {
  double most = -std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  std::vector<std::uint32_t> pending{0};
  while (!pending.empty()) {
    const std::uint32_t index = pending.back();
    const Node& at = nodes_[index];
    pending.pop_back();
    if (highest_along(at, direction) <= most) continue;
    if (at.second == 0) {
      for (std::uint32_t i = at.begin; i < at.end; ++i) {
        const double along = direction.dot(points_[i]);
        if (along > most) most = along, found = i;
      }
      continue;
    }
    std::uint32_t near = index + 1, far = at.second;
    if (highest_along(nodes_[near], direction) < highest_along(nodes_[far], direction)) {
      std::swap(near, far);
    }
    pending.push_back(far);
    pending.push_back(near);
  }
  return found;
}

}  // namespace beeline::internal
