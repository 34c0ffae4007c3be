#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/box_tree.h>

namespace beeline::internal {

AlignedBox box_around(const ConvexBody& body) {
  AlignedBox box;
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = Vector3::Unit(i);
    const double upper = support(body, axis), lower = -support(body, -axis);
    box.centre[i] = (upper + lower) / 2;
    box.half_extents[i] = (upper - lower) / 2 * (1 + 1e-14) + 1e-14 * magnitude(body);
  }
  return box;
}

void BoxRows::add(const AlignedBox& box) {
  constexpr double relative = 32 * std::numeric_limits<double>::epsilon();
  const double magnitude = box.centre.cwiseAbs().sum() + box.half_extents.sum();
  numbers_.insert(numbers_.end(),
                  {box.centre.x(), box.centre.y(), box.centre.z(), box.half_extents.x(),
                   box.half_extents.y(), box.half_extents.z(), relative * magnitude, 0});
}

BoxTree::BoxTree(const std::vector<ConvexBody>& bodies, const std::vector<double>& clearances) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    items.push_back({box_around(bodies[i]), clearances[i], static_cast<std::uint32_t>(i)});
  }
  nodes_.reserve(2 * items.size());
  if (!items.empty()) add(items, 0, items.size());
  for (const Node& node : nodes_) boxes_.add(node.box);
}

/// Divides the items at the middle of the axis along which their centres are spread most.
std::uint32_t BoxTree::add(std::vector<Item>& items, std::size_t begin, std::size_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node{
      .box = items[begin].box, .clearance = items[begin].clearance, .body = items[begin].body};
  if (end - begin > 1) {
    Vector3 lower = items[begin].box.centre, upper = lower;
    Vector3 least = lower - items[begin].box.half_extents,
            most = lower + items[begin].box.half_extents;
    for (std::size_t i = begin; i < end; ++i) {
      const AlignedBox& box = items[i].box;
      lower = lower.cwiseMin(box.centre);
      upper = upper.cwiseMax(box.centre);
      least = least.cwiseMin(box.centre - box.half_extents);
      most = most.cwiseMax(box.centre + box.half_extents);
      node.clearance = std::max(node.clearance, items[i].clearance);
    }
    node.box.centre = (least + most) / 2;
    node.box.half_extents =
        (most - least) / 2 * (1 + 1e-14) + 1e-14 * (least.cwiseAbs() + most.cwiseAbs());
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [axis](const Item& a, const Item& b) {
      return a.box.centre[axis] < b.box.centre[axis];
    });
    add(items, begin, middle);
    node.right = add(items, middle, end);
  }
  node.size = node.box.half_extents.norm();
  nodes_[index] = node;
  return index;
}

}  // namespace beeline::internal
