#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/convex_body.h>
#include <beeline/collision/internal/furthest_vertex.h>

namespace beeline::internal {
namespace {

using Core = ConvexBody::Core;

void set_core(const Sphere& sphere, ConvexBody& body) { body.radius = sphere.radius; }

void set_core(const Capsule& capsule, ConvexBody& body) {
  body.core = Core::segment;
  body.half_extents.z() = capsule.length / 2;
  body.radius = capsule.radius;
}

void set_core(const Box& box, ConvexBody& body) {
  body.core = Core::box;
  body.half_extents = box.size / 2;
}

void set_core(const Cylinder& cylinder, ConvexBody& body) {
  body.core = Core::cylinder;
  body.half_extents = {cylinder.radius, cylinder.radius, cylinder.length / 2};
}

void set_core(const HalfSpace&, ConvexBody& body) { body.core = Core::half_space; }

void set_core(const ConvexHull& hull, ConvexBody& body) {
  body.core = Core::hull;
  body.vertices = hull.vertices;
  Vector3 lower = hull.vertices.front(), upper = lower;
  for (const Vector3& vertex : hull.vertices) {
    lower = lower.cwiseMin(vertex);
    upper = upper.cwiseMax(vertex);
    body.extent = std::max(body.extent, vertex.cwiseAbs().sum());
  }
  body.centre = (lower + upper) / 2;
}

double infinite() { return std::numeric_limits<double>::infinity(); }

/// The largest distance of the core from its centre.
double core_size(const ConvexBody& body) {
  switch (body.core) {
    case Core::point:
    case Core::segment:
    case Core::box:
      return body.half_extents.norm();
    case Core::cylinder:
      return std::hypot(body.half_extents.x(), body.half_extents.z());
    case Core::half_space:
      break;
    case Core::hull: {
      double size = 0;
      for (const Vector3& vertex : body.vertices) {
        size = std::max(size, (vertex - body.centre).norm());
      }
      return size;
    }
  }
  return infinite();
}

double sign(double value) { return value < 0 ? -1 : 1; }

}  // namespace

ConvexBody convex_body(const Shape& shape) {
  ConvexBody body;
  std::visit([&](const auto& form) { set_core(form, body); }, shape.body);
  body.radius += shape.padding;
  body.bound = core_size(body) + body.radius;
  if (body.core != Core::hull) body.extent = body.half_extents.sum();
  const Pose pose = checked_pose(shape.pose);  // its axes are orthonormal
  return moved(pose.linear(), pose.translation(), body);
}

ConvexBody moved(const Rotation& rotation, const Vector3& translation, ConvexBody body) {
  body.origin = rotation * body.origin + translation;
  body.centre = rotation * body.centre + translation;
  body.axes = rotation * body.axes;
  return body;
}

double support(const ConvexBody& body, const Vector3& direction) {
  double value = direction.dot(body.origin);
  if (body.radius > 0) value += body.radius * direction.norm();
  switch (body.core) {
    case Core::point:
      return value;
    case Core::segment:
      return value + body.half_extents.z() * std::abs(direction.dot(body.axes.col(2)));
    case Core::box:
      return value + body.half_extents.dot((body.axes.transpose() * direction).cwiseAbs());
    case Core::cylinder: {
      const Vector3 local = body.axes.transpose() * direction;
      return value +
             body.half_extents.x() * std::sqrt(local.x() * local.x() + local.y() * local.y()) +
             body.half_extents.z() * std::abs(local.z());
    }
    case Core::half_space:
      return direction == body.axes.col(2) ? value : infinite();
    case Core::hull: {
      const Vector3 local = body.axes.transpose() * direction;
      return value + local.dot(furthest_vertex(body.vertices, local));
    }
  }
  return infinite();
}

double magnitude(const ConvexBody& body) {
  return body.origin.cwiseAbs().sum() + body.extent + body.radius;
}

double support_rounding(const ConvexBody& body) {
  // At most twelve products are added, and of the vertices of a hull one is chosen by two sums of
  // three, rounded otherwise.
  return 32 * std::numeric_limits<double>::epsilon() * magnitude(body);
}

Vector3 core_support(const ConvexBody& body, const Vector3& direction) {
  Vector3 local = body.axes.transpose() * direction;
  switch (body.core) {
    case Core::point:
    case Core::half_space:
      return body.origin;
    case Core::segment:
    case Core::box:
      local = body.half_extents.cwiseProduct(local.unaryExpr(&sign));
      break;
    case Core::cylinder: {
      const double across = std::hypot(local.x(), local.y());
      const double scale = across > 0 ? body.half_extents.x() / across : 0;
      local = {scale * local.x(), scale * local.y(), sign(local.z()) * body.half_extents.z()};
      break;
    }
    case Core::hull:
      local = furthest_vertex(body.vertices, local);
      break;
  }
  return body.origin + body.axes * local;
}

bool has_projection(ConvexBody::Core core) {
  switch (core) {
    case Core::point:
    case Core::segment:
    case Core::box:
    case Core::cylinder:
    case Core::half_space:
      return true;
    case Core::hull:
      break;
  }
  return false;
}

Vector3 projection_on_core(const ConvexBody& body, const Vector3& point) {
  Vector3 local = body.axes.transpose() * (point - body.origin);
  switch (body.core) {
    case Core::point:
      return body.origin;
    case Core::segment:
    case Core::box:
      local = local.cwiseMax(-body.half_extents).cwiseMin(body.half_extents);
      break;
    case Core::cylinder: {
      const double across = std::hypot(local.x(), local.y());
      if (across > body.half_extents.x()) local.head<2>() *= body.half_extents.x() / across;
      local.z() = std::clamp(local.z(), -body.half_extents.z(), body.half_extents.z());
      break;
    }
    case Core::half_space:
      local.z() = std::min(local.z(), 0.0);
      break;
    case Core::hull:
      throw Error("a hull has no closed form of a projection");
  }
  return body.origin + body.axes * local;
}

double farthest_distance(const ConvexBody& body, const Vector3& point) {
  if (body.core == Core::hull) {
    double farthest = 0;
    for (const Vector3& vertex : body.vertices) {
      farthest = std::max(farthest, (body.origin + body.axes * vertex - point).norm());
    }
    return farthest + body.radius;
  }
  const Vector3 from = body.origin - point;
  if (body.core == Core::segment || body.core == Core::box) {
    return ((body.axes.transpose() * from).cwiseAbs() + body.half_extents).norm() + body.radius;
  }
  return (body.centre - point).norm() + body.bound;
}

double farthest_distance(const ConvexBody& body, const Vector3& point, const Vector3& axis) {
  const auto across = [&](const Vector3& at) {
    const Vector3 v = at - point;
    return (v - v.dot(axis) * axis).norm();
  };
  if (body.core == Core::hull) {
    double farthest = 0;
    for (const Vector3& vertex : body.vertices) {
      farthest = std::max(farthest, across(body.origin + body.axes * vertex));
    }
    return farthest + body.radius;
  }
  if (body.core == Core::segment) {
    const Vector3 end = body.half_extents.z() * body.axes.col(2);
    return std::max(across(body.origin + end), across(body.origin - end)) + body.radius;
  }
  return across(body.centre) + body.bound;
}

}  // namespace beeline::internal
