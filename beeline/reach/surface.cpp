#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <beeline/reach/surface.h>

namespace beeline {
namespace {

using Node = std::array<Eigen::Index, 3>;

/// Corner c of a cube is offset from the first one by the bits of c: 1 x, 2 y, 4 z. The corners of
/// each face are counterclockwise seen from outside.
constexpr std::array<std::array<unsigned, 4>, 6> faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// An edge of a cube: its lower corner and 8 times its axis.
constexpr std::size_t edges = 24;
std::size_t edge_between(unsigned a, unsigned b) {
  const unsigned axis = (a ^ b) >> 1;  // 1, 2, 4 -> 0, 1, 2
  return std::min(a, b) + 8 * axis;
}

/// For each edge that the surface crosses, the one that follows it on the polygon around the
/// corners above the level, whose bits are set in `above`; otherwise -1. On a face, seen from
/// outside, the polygon goes from the edge before a run of corners above to the edge behind it; the
/// neighbour across the face takes the same two edges the other way round.
std::array<int, edges> next_edges(unsigned above) {
  std::array<int, edges> next;
  next.fill(-1);
  for (const auto& face : faces) {
    const auto corner = [&face](unsigned i) { return face[i % 4]; };
    const auto is_above = [&](unsigned i) { return (above >> corner(i) & 1) != 0; };
    for (unsigned i = 0; i < 4; ++i) {
      if (is_above(i) || !is_above(i + 1)) continue;
      unsigned last = i + 1;
      while (is_above(last + 1)) ++last;
      next[edge_between(corner(i), corner(i + 1))] =
          static_cast<int>(edge_between(corner(last), corner(last + 1)));
    }
  }
  return next;
}

/// The centres of the cells with a layer of nodes around them that are outside the grid; node
/// (0, 0, 0) is the first of that layer. Around a cylinder the layer is the cells themselves.
class Lattice {
 public:
  Lattice(const ReachGrid& grid, const std::vector<float>& values, double level)
      : grid_(grid), values_(values), level_(static_cast<float>(level)) {
    for (int k = 0; k < 3; ++k) cells_[k] = grid.axes()[k].cells;
    vertices_.resize(
        static_cast<std::size_t>(3 * (cells_[0] + 2) * (cells_[1] + 2) * (cells_[2] + 2)), -1);
  }

  ReachSurface surface() {
    Node cube;
    for (cube[0] = 0; cube[0] <= cells_[0]; ++cube[0]) {
      for (cube[1] = 0; cube[1] <= cells_[1]; ++cube[1]) {
        for (cube[2] = grid_.cylindrical() ? 1 : 0; cube[2] <= cells_[2]; ++cube[2]) add_cube(cube);
      }
    }
    const auto count = static_cast<Eigen::Index>(triangles_.size());
    ReachSurface surface;
    surface.triangles = Eigen::Map<const Eigen::Matrix3Xi>(triangles_.data(), 3, count / 3);
    // Radius, height and azimuth are left-handed.
    if (grid_.cylindrical()) surface.triangles.row(1).swap(surface.triangles.row(2));
    surface.vertices.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (Eigen::Index i = 0; i < surface.vertices.cols(); ++i) {
      surface.vertices.col(i) = points_[static_cast<std::size_t>(i)].cast<float>();
    }
    return surface;
  }

 private:
  /// The same node, of a cylinder with an azimuth from 1 to the number of cells.
  Node unique(Node node) const {
    if (grid_.cylindrical() && node[2] > cells_[2]) node[2] = 1;
    return node;
  }

  double value(Node node) const {
    node = unique(node);
    for (int k = 0; k < 3; ++k) {
      if (node[k] < 1 || node[k] > cells_[k]) return std::numeric_limits<double>::quiet_NaN();
    }
    const Eigen::Index p = ((node[0] - 1) * cells_[1] + node[1] - 1) * cells_[2] + node[2] - 1;
    return static_cast<double>(values_[static_cast<std::size_t>(p)]);
  }

  /// The polygons of the surface in the cube whose lowest corner is a node.
  void add_cube(const Node& cube) {
    unsigned above = 0;
    for (unsigned c = 0; c < 8; ++c) {
      if (value(corner_of(cube, c)) >= level_) above |= 1U << c;
    }
    if (above == 0 || above == 255) return;
    std::array<int, edges> next = next_edges(above);
    for (std::size_t first = 0; first < edges; ++first) {
      std::vector<int> polygon;
      for (std::size_t at = first; next[at] >= 0;) {
        polygon.push_back(vertex_on(cube, at));
        at = static_cast<std::size_t>(std::exchange(next[at], -1));
      }
      if (!polygon.empty()) add_polygon(polygon);
    }
  }

  static Node corner_of(Node cube, unsigned corner) {
    for (int k = 0; k < 3; ++k) cube[k] += corner >> k & 1;
    return cube;
  }

  /// The vertex on an edge of a cube, which four cubes share.
  int vertex_on(const Node& cube, std::size_t edge) {
    const auto axis = edge / 8;
    const Node low = unique(corner_of(cube, edge % 8));
    const Eigen::Index number =
        3 * ((low[0] * (cells_[1] + 2) + low[1]) * (cells_[2] + 2) + low[2]) +
        static_cast<Eigen::Index>(axis);
    int& vertex = vertices_[static_cast<std::size_t>(number)];
    if (vertex >= 0) return vertex;
    Node high = low;
    ++high[axis];
    const double from = value(low), to = value(high);
    const double fraction = (level_ - from) / (to - from);
    Vector3 place = Eigen::Map<const Eigen::Vector<Eigen::Index, 3>>(low.data()).cast<double>();
    place[static_cast<int>(axis)] += std::isfinite(fraction) ? fraction : 0.5;
    return vertex = add_vertex(point_of(place));
  }

  /// The point in the world of an index, not rounded, of nodes.
  Vector3 point_of(const Vector3& place) const {
    Vector3 coordinates;
    for (int k = 0; k < 3; ++k) {
      const ReachAxis& axis = grid_.axes()[k];
      coordinates[k] = axis.lower + (place[k] - 0.5) * axis.step;
    }
    return grid_.point(coordinates);
  }

  int add_vertex(const Vector3& point) {
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }

  /// A polygon is not flat: its triangles meet in its middle. A diagonal could be one of another
  /// polygon, too, and so belong to four triangles.
  void add_polygon(const std::vector<int>& polygon) {
    if (polygon.size() == 3) {
      triangles_.insert(triangles_.end(), polygon.begin(), polygon.end());
      return;
    }
    Vector3 sum = Vector3::Zero();
    for (const int vertex : polygon) sum += points_[static_cast<std::size_t>(vertex)];
    const int middle = add_vertex(sum / static_cast<double>(polygon.size()));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      triangles_.insert(triangles_.end(), {middle, polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }

  const ReachGrid& grid_;
  const std::vector<float>& values_;
  double level_;
  Node cells_{};
  std::vector<int> vertices_;    // by the lower node of their edge and its axis; -1: none
  std::vector<Vector3> points_;  // the vertices
  std::vector<int> triangles_;
};

}  // namespace

ReachSurface reach_surface(const ReachGrid& grid, const std::vector<float>& values, double level) {
  if (values.size() != static_cast<std::size_t>(grid.positions())) {
    throw Error("a surface takes a value for each of the " + std::to_string(grid.positions()) +
                " positions; there are " + std::to_string(values.size()));
  }
  if (std::isnan(level)) throw Error("the level of the surface is NaN");
  constexpr Eigen::Index fewest = 3;  // otherwise cells are neighbours on both sides
  if (grid.cylindrical() && grid.azimuths() < fewest) {
    throw Error("a surface takes 3 azimuths or more; there are " + std::to_string(grid.azimuths()));
  }
  return Lattice(grid, values, level).surface();
}

}  // namespace beeline
