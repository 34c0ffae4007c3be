#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <beeline/collision/scene.h>

namespace beeline::testing {

// Distances of spheres, capsules and boxes in closed form, for comparison: no code of the library.

/// The points within `radius` of a box, whose half sizes may be 0: a point or a segment.
struct RoundedBox {
  Vector3 centre = Vector3::Zero();
  Rotation axes = Rotation::Identity();
  Vector3 half = Vector3::Zero();
  double radius = 0;
};

inline RoundedBox rounded_box(const Shape& shape, const Pose& frame) {
  const Pose pose = frame * shape.pose;
  RoundedBox body{pose.translation(), pose.linear(), Vector3::Zero(), shape.padding};
  if (const auto* sphere = std::get_if<Sphere>(&shape.body)) {
    body.radius += sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.body)) {
    body.half.z() = capsule->length / 2;
    body.radius += capsule->radius;
  } else if (const auto* box = std::get_if<Box>(&shape.body)) {
    body.half = box->size / 2;
  } else {
    throw Error("no closed form for a " + kind_name(shape));
  }
  return body;
}

inline double distance_to_core(const RoundedBox& body, const Vector3& point) {
  const Vector3 local = body.axes.transpose() * (point - body.centre);
  return (local.cwiseAbs() - body.half).cwiseMax(0).norm();
}

inline std::vector<Vector3> corners_of(const RoundedBox& body) {
  std::vector<Vector3> corners{body.centre};
  for (int i = 0; i < 3; ++i) {
    if (body.half[i] == 0) continue;
    const Vector3 aside = body.half[i] * body.axes.col(i);
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) corners.emplace_back(corners[k] + aside);
    for (std::size_t k = 0; k < count; ++k) corners[k] -= aside;
  }
  return corners;
}

using LineSegment = std::array<Vector3, 2>;

inline std::vector<LineSegment> edges_of(const RoundedBox& body) {
  std::vector<LineSegment> edges;
  for (int i = 0; i < 3; ++i) {
    if (body.half[i] == 0) continue;
    RoundedBox across = body;
    across.half[i] = 0;
    const Vector3 aside = body.half[i] * body.axes.col(i);
    for (const Vector3& middle : corners_of(across))
      edges.push_back({middle - aside, middle + aside});
  }
  return edges;
}

/// The distance of two segments (Ericson, "Real-time collision detection", 2005, section 5.1.9).
inline double distance_of(const LineSegment& a, const LineSegment& b) {
  const Vector3 u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double determinant = uu * vv - uv * uv;
  const auto clamped = [](double value) { return std::clamp(value, 0.0, 1.0); };
  double s = determinant > 1e-14 * uu * vv ? clamped((uv * vw - vv * uw) / determinant) : 0;
  double t = vv > 0 ? (uv * s + vw) / vv : 0;
  if (t < 0 || t > 1) {
    t = clamped(t);
    s = uu > 0 ? clamped((uv * t - uw) / uu) : 0;
  }
  return (w + s * u - t * v).norm();
}

/// Whether one of the normals of faces and of pairs of edges separates the cores.
inline bool have_separating_axis(const RoundedBox& a, const RoundedBox& b) {
  const auto separates = [&](const Vector3& n) {
    const double reach = a.half.dot((a.axes.transpose() * n).cwiseAbs()) +
                         b.half.dot((b.axes.transpose() * n).cwiseAbs());
    return std::abs(n.dot(b.centre - a.centre)) > reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(a.axes.col(i)) || separates(b.axes.col(i))) return true;
    for (int j = 0; j < 3; ++j) {
      const Vector3 n = a.axes.col(i).cross(b.axes.col(j));
      if (n.norm() > 1e-9 && separates(n.normalized())) return true;
    }
  }
  return false;
}

/// The distance of two bodies, 0 if they overlap, or anything above `limit` if it is above that.
inline double closed_form_distance(const RoundedBox& a, const RoundedBox& b,
                                   double limit = std::numeric_limits<double>::infinity()) {
  const double radii = a.radius + b.radius;
  const double apart = (a.centre - b.centre).norm() - a.half.norm() - b.half.norm() - radii;
  if (apart > limit) return apart;
  if (!have_separating_axis(a, b)) return 0;
  double distance = std::numeric_limits<double>::infinity();
  for (const Vector3& corner : corners_of(a)) {
    distance = std::min(distance, distance_to_core(b, corner));
  }
  for (const Vector3& corner : corners_of(b)) {
    distance = std::min(distance, distance_to_core(a, corner));
  }
  const std::vector<LineSegment> others = edges_of(b);
  for (const LineSegment& edge : edges_of(a)) {
    for (const LineSegment& other : others) distance = std::min(distance, distance_of(edge, other));
  }
  return std::max(0.0, distance - radii);
}

}  // namespace beeline::testing
