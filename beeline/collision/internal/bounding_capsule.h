#pragma once

#include <vector>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// The points within `radius` of the segment from centre - half_axis to centre + half_axis: a
/// simple body around others, whose support values take two products of vectors.
struct BoundingCapsule {
  Vector3 centre = Vector3::Zero(), half_axis = Vector3::Zero();
  double radius = 0;

  double size() const {
    return half_axis.norm() + radius;
  }  ///< largest distance from the centre, m
};

/// Returns a capsule that contains the body, rounded outwards, unless the body is a capsule or a
/// sphere: then it is the body. It contains everything (its radius is infinite) if a number of the
/// body is not finite. Not for half-spaces.
BoundingCapsule capsule_around(const ConvexBody& body);

/// Returns a capsule that contains capsules, at least one, rounded outwards. It contains everything
/// if one of them has a number that is not finite.
BoundingCapsule capsule_around(const std::vector<BoundingCapsule>& capsules);

/// Estimates the largest distance of the capsule's surface from a body inside, m, from 26
/// directions. Not a bound.
double estimated_excess(const BoundingCapsule& capsule, const ConvexBody& body);

/// Whether capsule_around() returns the body itself.
bool is_capsule(const ConvexBody& body);

/// Two points, of which each belongs to a segment.
struct SegmentPoints {
  Vector3 on_a, on_b;
};

/// Returns the nearest points of the segments of two capsules.
SegmentPoints nearest_on_segments(const BoundingCapsule& a, const BoundingCapsule& b);

/// A bound of the numbers that are added for a support value of the capsule, m.
double magnitude(const BoundingCapsule& capsule);

}  // namespace beeline::internal
