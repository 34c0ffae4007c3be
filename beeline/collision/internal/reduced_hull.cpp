#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <beeline/collision/internal/nearest_points.h>
#include <beeline/collision/internal/point_tree.h>
#include <beeline/collision/internal/reduced_hull.h>

namespace beeline::internal {
namespace {

constexpr std::size_t keeps_all = 100, most_vertices = 2000;
constexpr double most_growth = 1e-4, most_relative_growth = 1e-3;  // m, of the size

bool comes_before(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// The points of a tree, and the vertices that are selected among them.
class HullSelection {
 public:
  explicit HullSelection(std::vector<Vector3> points) : tree_(std::move(points)) {
    const PointTree::Node& root = tree_.node(0);
    const Vector3 extent = root.upper - root.lower;
    centre_ = (root.lower + root.upper) / 2;
    size_ = extent.maxCoeff();
    bound_ = extent.norm() / 2;
    // Each coordinate of a weighted mean has five products and sums of numbers of this size. The
    // square of a smaller distance than 1e-150 m is 0.
    rounding_ = 64 * std::numeric_limits<double>::epsilon() *
                    root.lower.cwiseAbs().cwiseMax(root.upper.cwiseAbs()).sum() +
                1e-150;
    is_selected_.assign(tree_.points().size(), false);
    of_point_.assign(tree_.points().size(), std::numeric_limits<double>::infinity());
    of_node_.assign(tree_.node_count(), std::numeric_limits<double>::infinity());
    face_.fill(Vector3::Zero());
  }

  ReducedHull select() {
    select_in_fixed_directions();
    const double least = std::min(most_growth, most_relative_growth * size_);
    for (double tolerance = size_ / 16;; tolerance /= 2) {
      cover(std::max(tolerance, least));
      if (tolerance <= least || vertices_.size() >= most_vertices) break;
    }
    double growth = 0;
    if (vertices_.size() < tree_.points().size()) {
      growth = std::nextafter(measured() + rounding_, std::numeric_limits<double>::infinity());
    }
    std::sort(vertices_.begin(), vertices_.end(), comes_before);
    return {.vertices = std::move(vertices_), .growth = growth};
  }

 private:
  /// A node of the tree with the vertices that are near it, to which its points are compared first.
  struct Visit {
    std::uint32_t node = 0;
    std::vector<Vector3> near = {};
  };

  void add(std::uint32_t place) {
    if (is_selected_[place]) return;
    is_selected_[place] = true;
    of_point_[place] = 0;
    vertices_.push_back(tree_.points()[place]);
  }

  /// Directions on a spiral around the sphere, at equal heights.
  void select_in_fixed_directions() {
    constexpr int count = 200;
    for (int i = 0; i < count; ++i) {
      const double z = 1 - (2 * i + 1) / static_cast<double>(count);
      const double across = std::sqrt(1 - z * z),
                   angle = std::numbers::phi * 2 * std::numbers::pi * i;
      add(tree_.furthest({across * std::cos(angle), across * std::sin(angle), z}));
    }
  }

  HullPoint nearest(const Vector3& point, const std::vector<Vector3>& vertices) const {
    ConvexBody hull{.core = ConvexBody::Core::hull, .vertices = vertices};
    hull.centre = centre_;
    hull.bound = bound_;
    return nearest_in_hull(point, hull);
  }

  /// An upper bound of the distance of a point from the hull of vertices.
  double distance(const Vector3& point, const std::vector<Vector3>& vertices) {
    const HullPoint found = nearest(point, vertices);
    if (found.count == 3) face_ = found.vertices;
    const double distance = (point - found.mean).norm();
    return std::isnan(distance) ? (point - vertices.front()).norm() : distance;
  }

  /// The distance of a point from the last triangle of vertices that distance() found, which is
  /// often the one next to the point too; infinite if the foot is outside.
  double distance_of_last_face(const Vector3& point) const {
    const Vector3 b = face_[1] - face_[0], c = face_[2] - face_[0], p = point - face_[0];
    const double bb = b.dot(b), bc = b.dot(c), cc = c.dot(c), pb = p.dot(b), pc = p.dot(c);
    const double area = bb * cc - bc * bc;
    const double v = (cc * pb - bc * pc) / area, w = (bb * pc - bc * pb) / area;
    const bool inside = v >= 0 && w >= 0 && v + w <= 1;  // false for NaN
    if (!inside) return std::numeric_limits<double>::infinity();
    return (point - ((1 - v - w) * face_[0] + v * face_[1] + w * face_[2])).norm();
  }

  /// An upper bound of the distance of all points of a node from the hull of vertices; if it
  /// exceeds `most`, of one of its corners. Begins with the corner that is furthest from the
  /// centre.
  double distance_of_box(const PointTree::Node& node, const std::vector<Vector3>& vertices,
                         double most) {
    int first = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (node.lower[axis] + node.upper[axis] > 2 * centre_[axis]) first |= 1 << axis;
    }
    double farthest = 0;
    for (int flips = 0; flips < 8 && farthest <= most; ++flips) {
      const int corner = first ^ flips;
      Vector3 at = node.lower;
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) != 0) at[axis] = node.upper[axis];
      }
      farthest = std::max(farthest, distance(at, vertices));
    }
    return farthest;
  }

  /// The half of the vertices that is nearer to the node, and no fewer than 32.
  static std::vector<Vector3> nearer_half(const PointTree::Node& node,
                                          std::vector<Vector3> vertices) {
    const std::size_t count = std::max<std::size_t>(32, vertices.size() / 2);
    if (count >= vertices.size()) return vertices;
    const Vector3 centre = (node.lower + node.upper) / 2;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      order.emplace_back((vertices[i] - centre).squaredNorm(), i);
    }
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                     order.end());
    std::vector<Vector3> near;
    for (std::size_t i = 0; i < count; ++i) near.push_back(vertices[order[i].second]);
    return near;
  }

  /// Calls at_point(place, near) for the points that are not known to be within `tolerance` of the
  /// hull. Ends when there are enough vertices and `adds`.
  template <class AtPoint>
  void visit(const double& tolerance, bool adds, AtPoint&& at_point) {
    std::vector<Visit> pending;
    pending.push_back({0, vertices_});
    while (!pending.empty() && !(adds && vertices_.size() >= most_vertices)) {
      const Visit at = std::move(pending.back());
      pending.pop_back();
      if (of_node_[at.node] <= tolerance) continue;
      const PointTree::Node& node = tree_.node(at.node);
      if (node.second == 0) {
        double most = 0;
        for (std::uint32_t place = node.begin; place < node.end; ++place) {
          if (of_point_[place] > tolerance) at_point(place, at.near);
          most = std::max(most, of_point_[place]);
        }
        of_node_[at.node] = most;
        continue;
      }
      const double of_box = distance_of_box(node, at.near, tolerance);
      if (of_box <= tolerance) {
        of_node_[at.node] = of_box;
        continue;
      }
      for (const std::uint32_t child : {node.second, at.node + 1}) {
        pending.push_back({child, nearer_half(tree_.node(child), at.near)});
      }
    }
  }

  /// Adds vertices until all points are within `tolerance` of their hull, or there are enough.
  void cover(double tolerance) {
    visit(tolerance, true, [&](std::uint32_t place, const std::vector<Vector3>& near) {
      const Vector3& point = tree_.points()[place];
      double& outside = of_point_[place];
      outside = std::min(outside, distance_of_last_face(point));
      if (outside > tolerance) outside = std::min(outside, distance(point, near));
      if (outside > tolerance) outside = std::min(outside, distance(point, vertices_));
      while (outside > tolerance && vertices_.size() < most_vertices) {
        const std::uint32_t extreme = tree_.furthest(point - nearest(point, vertices_).mean);
        add(is_selected_[extreme] ? place : extreme);
        outside = std::min(outside, distance(point, vertices_));
      }
    });
  }

  /// The largest distance of a point from the hull; of a box only where it is no larger.
  double measured() {
    double most = 0;
    visit(most, false, [&](std::uint32_t place, const std::vector<Vector3>& near) {
      const Vector3& point = tree_.points()[place];
      double& outside = of_point_[place];
      outside = std::min(outside, distance(point, near));
      if (outside > most) outside = std::min(outside, distance(point, vertices_));
      most = std::max(most, outside);
    });
    return most;
  }

  PointTree tree_;
  Vector3 centre_;
  double size_ = 0, bound_ = 0, rounding_ = 0;
  std::vector<bool> is_selected_;
  std::vector<Vector3> vertices_;
  /// Upper bounds of distances from the hull. They stay valid while it grows.
  std::vector<double> of_point_, of_node_;
  std::array<Vector3, 4> face_{};  ///< of the first three; at first, no triangle
};

}  // namespace

ReducedHull reduced_hull(std::vector<Vector3> points) {
  std::sort(points.begin(), points.end(), comes_before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() <= keeps_all) return {.vertices = std::move(points), .growth = 0};
  return HullSelection(std::move(points)).select();
}

}  // namespace beeline::internal
