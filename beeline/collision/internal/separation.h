#pragma once

#include <beeline/collision/internal/nearest_points.h>

namespace beeline::internal {

/// A lower bound of the distance of two bodies, from a direction, and an upper bound, from two
/// points. Both are rounded outwards, so they hold whoever proposed the direction and the points.
struct Separation {
  /// At most the distance, m; negative if the direction does not separate the bodies: moving one
  /// of them by this distance along the direction would.
  double lower = 0;
  double upper = 0;  ///< at least the distance, m
  NearestPoints points;
};

/// Computes the bounds for nearest_points(). If the first body is a half-space, the bodies must be
/// exchanged.
Separation separation(const ConvexBody& a, const ConvexBody& b,
                      const Vector3& guess = Vector3::UnitX(), double tolerance = 0,
                      SearchStart* start = nullptr);

}  // namespace beeline::internal
