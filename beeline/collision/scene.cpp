#include <array>
#include <cmath>

#include <beeline/collision/scene.h>

namespace beeline {
namespace {

void check_length(double value, const char* what) {
  if (value >= 0 && value <= max_shape_size) return;
  throw Error(std::string(what) + " of " + number(value) + " m; it must be from 0 to " +
              number(max_shape_size) + " m");
}

void check_body(const Sphere& sphere) { check_length(sphere.radius, "a sphere has a radius"); }

void check_body(const Capsule& capsule) {
  check_length(capsule.radius, "a capsule has a radius");
  check_length(capsule.length, "a capsule has a length");
}

void check_body(const Box& box) {
  for (const double edge : box.size) check_length(edge, "a box has an edge");
}

void check_body(const Cylinder& cylinder) {
  check_length(cylinder.radius, "a cylinder has a radius");
  check_length(cylinder.length, "a cylinder has a length");
}

void check_body(const HalfSpace&) {}

void check_body(const ConvexHull& hull) {
  if (hull.vertices.empty()) throw Error("a convex hull has no vertices");
  for (const Vector3& vertex : hull.vertices) {
    for (const double coordinate : vertex) {
      check_length(std::abs(coordinate), "a convex hull has a coordinate");
    }
  }
}

constexpr std::array kind_names{"sphere",   "capsule",    "box",
                                "cylinder", "half_space", "convex_hull"};
static_assert(kind_names.size() == std::variant_size_v<Shape::Body>);

}  // namespace

std::string kind_name(const Shape& shape) { return kind_names[shape.body.index()]; }

std::vector<std::string> shape_kind_names() { return {kind_names.begin(), kind_names.end()}; }

void check_shape(const Shape& shape) {
  std::visit([](const auto& body) { check_body(body); }, shape.body);
  check_length(shape.padding, "a shape has a padding");
  if (!shape.hull_of.empty() && !std::holds_alternative<ConvexHull>(shape.body)) {
    throw Error("a " + kind_name(shape) + " is no convex_hull of a mesh (hull_of)");
  }
  const std::string fault = rigid_motion_fault(shape.pose);
  if (!fault.empty()) throw Error("the pose of a " + kind_name(shape) + ": " + fault);
  for (const double coordinate : shape.pose.translation()) {
    check_length(std::abs(coordinate), "the position of a shape has a coordinate");
  }
}

void check_cloud(const PointCloud& cloud) {
  check_length(cloud.radius, "a point cloud has a radius");
  if (cloud.points.empty()) throw Error("a point cloud has no points");
  if (cloud.points.size() > max_cloud_points) {
    throw Error("a point cloud has " + std::to_string(cloud.points.size()) + " points; at most " +
                std::to_string(max_cloud_points) + " are possible: reduce it");
  }
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector3& point = cloud.points[i];
    if (point.cwiseAbs().maxCoeff() <= max_shape_size && point.allFinite()) continue;
    throw Error("point " + std::to_string(i) + " of a point cloud (indices begin at 0) has a " +
                "coordinate that is " +
                (point.allFinite() ? "beyond " + number(max_shape_size) + " m"
                                   : "not a finite number; leave such points out"));
  }
}

void check_clearance(double clearance) {
  if (clearance > 0 && clearance <= max_shape_size) return;
  throw Error::of("clearance", "a clearance of " + number(clearance) +
                                   " m; it must be above 0 and at most " + number(max_shape_size) +
                                   " m");
}

}  // namespace beeline
