#include <cmath>
#include <numbers>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/ros_shapes.h>

namespace beeline::internal {

Shape cone(double radius, double length) {
  check_shape({.body = Cylinder{radius, length}});
  constexpr int sides = 64;
  // The middles of the pyramid's sides are at the cone's radius; the factor covers the rounding.
  const double outer = radius / std::cos(std::numbers::pi / sides) * (1 + 1e-14);
  ConvexHull hull{{Vector3(0, 0, length / 2)}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    hull.vertices.emplace_back(outer * std::cos(angle), outer * std::sin(angle), -length / 2);
  }
  return {.body = std::move(hull)};
}

Shape plane(double a, double b, double c, double d) {
  const Vector3 normal(a, b, c);
  const double length = normal.norm();
  if (!(length > 0) || !std::isfinite(length)) throw Error("the normal of a plane is 0");
  const Vector3 origin = -d / length * (normal / length);
  if (!(origin.norm() <= max_shape_size)) {
    throw Error("the plane is farther away than " + number(max_shape_size) + " m");
  }
  const Vector3 z = normal / length, x = z.unitOrthogonal();
  Rotation axes;
  axes << x, z.cross(x), z;
  return {.body = Box{Vector3(max_shape_size, max_shape_size, 0)}, .pose = make_pose(origin, axes)};
}

Pose ros_pose(const Vector3& position, const std::array<double, 4>& quaternion) {
  const auto& [qx, qy, qz, qw] = quaternion;
  Pose pose = Pose::Identity();
  if (qx != 0 || qy != 0 || qz != 0 || qw != 0) {
    pose.linear() = rotation_from_quaternion(qw, qx, qy, qz);
  }
  pose.translation() = position;
  return pose;
}

}  // namespace beeline::internal
