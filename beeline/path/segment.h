#pragma once

#include <variant>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

// All poses of segments and paths are world_T_tool; vectors and points are in world axes, metres
// and radians.

/// A straight line for the tool, interpolate(from, to, s) with s from 0 to 1: the orientation
/// follows the shortest rotation. Poses of segments and paths are world_T_tool.
struct Line {
  Pose from;  ///< pose at s = 0
  Pose to;    ///< pose at s = 1
};

/// A screw motion from one pose to the other, with a rotation angle of at most pi: the tool origin
/// moves on a helix about a fixed axis, and the orientation follows the shortest rotation.
struct ScrewLine {
  Pose from;  ///< pose at s = 0
  Pose to;    ///< pose at s = 1
};

/// A circular arc: the tool origin rotates about the axis through `centre` along `rotation`, and
/// the orientation follows the shortest rotation. Both rates are constant. See arc_through().
struct Arc {
  Pose from;       ///< pose at s = 0
  Pose to;         ///< pose at s = 1
  Vector3 centre;  ///< centre of the circle in the world, m
  /// Rotation vector in world axes, whose length is the arc's angle, at most 2 pi rad.
  Vector3 rotation;
};

/// A segment of a spline, or a blend. The polynomial [x; r](s) = sum_k terms_k s^k has the columns
/// of `terms` as coefficients, in world axes. The position is the position of `centre` plus x, and
/// the orientation is exp(r) times the orientation of `centre`. Intended for |r| <= pi.
struct SplineSegment {
  Pose centre = Pose::Identity();  ///< pose at the zero of the polynomial
  /// Coefficients of the polynomial, m and rad, (6, 6); column k has the coefficients of s^k.
  Matrix6 terms = Matrix6::Zero();
};

/// One segment of a tool path; the segment parameter s runs from 0 to 1. CONTRIBUTING.md says where
/// a new type of segment is added.
using Segment = std::variant<Line, ScrewLine, Arc, SplineSegment>;

/// The arc from `from` to `to` through a third position. Throws Error if the three positions do not
/// determine a circle: two of them coincide, or all lie on a straight line to 1e-6 of their
/// distance.
Arc arc_through(const Pose& from, const Vector3& passed, const Pose& to);

/// The pose (world_T_tool) at the segment parameter s.
Pose pose_at(const Segment& segment, double s);

/// The pose at the segment parameter s, and its derivatives with respect to s.
PoseMotion motion_at(const Segment& segment, double s);

/// Path length of the tool origin, metres. Exact except for splines, which are integrated by
/// Gauss-Legendre quadrature with 80 points (about ten digits unless the origin comes to rest).
double length_of(const Segment& segment);

/// The segment traversed from its end to its beginning. A segment that rotates by exactly pi may
/// rotate in the other direction.
Segment reversed(const Segment& segment);

/// Whether the segment rotates about the world's z axis only, as planar arms do.
bool rotates_about_z(const Segment& segment);

}  // namespace beeline
