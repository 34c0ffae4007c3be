#pragma once

#include <beeline/path/segment.h>

namespace beeline::internal {

/// Proved bounds on the difference between a segment from s_a to s_b and its chord
/// interpolate(pose_at(s_a), pose_at(s_b), t), at equal fractions t; metres and radians.
struct SegmentChordBound {
  double position = 0;     ///< bound of |d(t)|, d(t) = segment's position - chord's position
  double orientation = 0;  ///< bound of the angle between the orientations; <= pi
  /// d(t) = -4 t (1 - t) curvature_term + e(t), |e(t)| <= remainder.
  Vector3 curvature_term = Vector3::Zero();
  double remainder = 0;
  double rotation = 0;                             ///< bound of the integral of |w|
  Vector3 angular_acceleration = Vector3::Zero();  ///< w' at t = 1/2, radians
  double angular_remainder = 0;                    ///< bound of |w''| / 6, see orientation_gap()
};

/// Lines: zero. Screws and arcs of angle f <= 2 pi and radius r: the sagitta r (1 - cos(f/2)),
/// exactly; their orientation is the chord's orientation. Splines: d'' = p'' with d(0) = d(1) = 0
/// for positions, and orientation_gap() for orientations, with
///     |w'| <= |r''| + |r x r'||r'| / 6,   |w''| <= |r'''| + (3/2)|r'||r''| + |r'|^3 / 3,
/// because w = J r', J being the mean of exp(u [r]x) for u from 0 to 1. The orientation bound of a
/// spline is pi if the integral of |w| may reach pi.
SegmentChordBound segment_chord_bound(const Segment& segment, double s_a, double s_b);

}  // namespace beeline::internal
