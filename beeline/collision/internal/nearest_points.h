#pragma once

#include <array>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// Two points of two bodies that are close to each other, and a direction that separates the
/// bodies if they are apart. Nothing here is proved: see separation().
struct NearestPoints {
  Vector3 on_a = Vector3::Zero();  ///< a point of the first body
  Vector3 on_b = Vector3::Zero();  ///< a point of the second body
  /// Unit vector from the first body to the second along which their distance is largest.
  Vector3 direction = Vector3::UnitX();
};

/// The simplex of the last search for two bodies, in the frames of their cores. A search for the
/// same bodies in the same order begins with it: where they have moved little, it takes few steps.
struct SearchStart {
  std::array<Vector3, 3> on_a = {}, on_b = {};
  int count = 0;  ///< number of points; 0 for none
};

/// Proposes the nearest points of two bodies in one frame by the algorithm of Gilbert, Johnson and
/// Keerthi ("A fast procedure for computing the distance between complex objects in
/// three-dimensional space", 1988) on their cores, or in closed form for points, segments and a
/// half-space. If the cores intersect, the points coincide to rounding, and the direction is the
/// best of those that the axes of both bodies give. Begins with `guess`, a direction from the
/// first body to the second, or with `start`, which becomes the start of the next search, and ends
/// once the distance is known to `tolerance`, m, or to rounding. The second body may be a
/// half-space, but not the first.
NearestPoints nearest_points(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                             double tolerance = 0, SearchStart* start = nullptr);

/// Whether two bodies in one frame seem to be closer than `distance`, by the same search, which
/// ends as soon as that is clear.
bool are_closer(const ConvexBody& a, const ConvexBody& b, double distance, const Vector3& guess);

/// A point of the hull of vertices: their weighted mean, with weights that are not negative.
struct HullPoint {
  Vector3 mean = Vector3::Zero();        ///< to rounding
  std::array<Vector3, 4> vertices = {};  ///< those with a weight
  int count = 0;                         ///< number of these vertices, 1 to 4
};

/// Proposes the point of a hull that is nearest to `point`, by the same algorithm. `hull` has the
/// core hull, the identity as its axes and no origin.
HullPoint nearest_in_hull(const Vector3& point, const ConvexBody& hull);

}  // namespace beeline::internal
