#pragma once

#include <vector>

#include <beeline/collision/internal/convex_body.h>

namespace beeline::internal {

/// The points within `radius` of the segment from centre - half to centre + half: a simple body
/// around others, whose support values take two products of vectors.
struct BoundingCapsule {
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
  double radius = 0;

  double size() const { return half.norm() + radius; }  ///< largest distance from the centre, m
};

/// Returns a capsule that contains the body, rounded outwards, unless the body is a capsule or a
/// sphere: then it is the body. Not for half-spaces.
BoundingCapsule capsule_around(const ConvexBody& body);

/// Returns a capsule that contains capsules, at least one, rounded outwards.
BoundingCapsule capsule_around(const std::vector<BoundingCapsule>& capsules);

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
