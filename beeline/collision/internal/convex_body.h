#pragma once

#include <span>

#include <beeline/collision/scene.h>

namespace beeline::internal {

/// A shape in the frame that carries it, a link's or the world: the points within `radius` of a
/// core, which is a point, a segment, a box, a cylinder, a half-space or the hull of points.
struct ConvexBody {
  enum class Core { point, segment, box, cylinder, half_space, hull };

  Core core = Core::point;
  Vector3 origin = Vector3::Zero();  ///< origin of the core: its centre, unless it is a hull
  /// Axes of the core. The segment and the cylinder are along z, and z is the normal of the
  /// half-space, outwards.
  Rotation axes = Rotation::Identity();
  Vector3 half_extents =
      Vector3::Zero();  ///< half the size of the core along the axes; its radius is x
  double radius = 0;    ///< distance of the surface from the core, m
  std::span<const Vector3> vertices = {};  ///< of a hull, from the origin along the axes
  Vector3 centre = Vector3::Zero();        ///< centre of a sphere that contains the body
  double bound = 0;                        ///< radius of that sphere, m
  /// Sum of the coordinates' absolute values of the farthest vertex, or of `half_extents`, m.
  double extent = 0;
};

// Bounds that are proved use support(), farthest_distance(), `centre` and `bound`, and
// projection_on_core() for points inside a body. core_support() only proposes directions.

/// Returns the body of a valid shape (check_shape()), which must outlive it.
ConvexBody convex_body(const Shape& shape);

/// Returns the body moved by a rigid motion, so that another frame carries it.
ConvexBody moved(const Rotation& rotation, const Vector3& translation, ConvexBody body);

/// Returns the maximum of direction . x over the points of the body, to rounding. The direction may
/// have any length. For a half-space it is finite only in the direction of its normal.
double support(const ConvexBody& body, const Vector3& direction);

/// A bound of the numbers of which support() is the sum, m. `bound` is none where the origin and
/// the vertices of a hull are far from each other.
double magnitude(const ConvexBody& body);

/// A bound of the rounding of support() for a unit direction, m.
double support_rounding(const ConvexBody& body);

/// Returns a point of the core that is furthest in the direction. Not for half-spaces.
Vector3 core_support(const ConvexBody& body, const Vector3& direction);

/// Whether the core has a closed form for its nearest point.
bool has_projection(ConvexBody::Core core);

/// Returns the point of a core with has_projection() that is nearest to a point.
Vector3 projection_on_core(const ConvexBody& body, const Vector3& point);

/// The radius of a sphere about `point` that contains the body, the smallest one to rounding for
/// points, segments, boxes and hulls.
double farthest_distance(const ConvexBody& body, const Vector3& point);

/// A bound of the distance of the body's points from the line through `point` along the unit
/// vector `axis`.
double farthest_distance(const ConvexBody& body, const Vector3& point, const Vector3& axis);

}  // namespace beeline::internal
