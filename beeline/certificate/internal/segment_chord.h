#pragma once

#include <beeline/path/segment.h>

namespace beeline {

/// Proved bounds on how far a segment leaves, from s_a to s_b, the chord interpolate(pose_at(s_a),
/// pose_at(s_b), t) at the same share t of the way; metres and radians.
struct SegmentChordBound {
  double position = 0;
  double orientation = 0;
  /// The distance as a vector is -4 t (1 - t) bend, but for something of length `rest` at most.
  Vector3 bend = Vector3::Zero();
  double rest = 0;
  double turned = 0;                ///< length of the way of its orientation, at most
  Vector3 swing = Vector3::Zero();  ///< the change of the angular velocity by t, half-way
  double swing_rest = 0;            ///< what to add to its size for how it differs at other times
};

/// Nothing for lines. Screws and arcs: the rise r (1 - cos(f/2)) of the arc of angle f, at most
/// 2 pi, exactly; their orientation keeps to the chord's. Splines: from the second derivatives,
///     d'' = p'',  d(0) = d(1) = 0
/// for positions; for orientations as chord_bound() does, with
///     |w'| <= |r''| + |r x r'||r'| / 6,   |w''| <= |r'''| + (3/2)|r'||r''| + |r'|^3 / 3,
/// and pi where they may turn by pi or more: w = J r', J being the mean of exp(u [r]x) for u from
/// 0 to 1.
SegmentChordBound segment_chord_bound(const Segment& segment, double s_a, double s_b);

}  // namespace beeline
