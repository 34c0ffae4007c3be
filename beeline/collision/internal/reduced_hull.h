#pragma once

#include <cstddef>
#include <vector>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// A hull of few vertices which, grown by `growth` in all directions, contains points.
struct ReducedHull {
  std::vector<Vector3> vertices = {};  ///< some of the points, m
  double growth = 0;                   ///< m, rounded up
};

/// Selects vertices of the convex hull of points (m): all of up to 100 points, otherwise extreme
/// points until each point is within min(0.1 mm, 0.1 % of the size) of their hull, or until there
/// are 2,000. `growth` is the largest distance of a point from the hull:
///     growth = max_p min_w |p - sum_i w_i v_i|  with  w_i >= 0, sum_i w_i = 1.
/// It is proved by a sum of this kind for each point, or for the corners of a box that contains the
/// point: the distance from a convex set is a convex function, so its maximum over a box is at a
/// corner. Repeated points count once. The same points, in any order, give the same hull. Requires
/// a point at least, and finite coordinates.
ReducedHull reduced_hull(std::vector<Vector3> points);

}  // namespace beeline::internal
