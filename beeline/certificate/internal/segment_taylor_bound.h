#pragma once

#include <beeline/kinematics/internal/taylor_bound.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// Bounds on the Taylor coefficients of a segment's pose with respect to the segment parameter s;
/// metres and radians. position.c[0] and rotation.c[0] are not set.
struct SegmentTaylorBound {
  TaylorBound position;
  TaylorBound rotation;  ///< bound of the rotation vector relative to a fixed orientation
};

/// Returns the bounds for s from `from` to `to`.
SegmentTaylorBound segment_taylor_bound(const Segment& segment, double from, double to);

}  // namespace beeline::internal
