#pragma once

#include <variant>

#include <beeline/pose/se3.h>

namespace beeline {

/// A straight line for the tool: interpolate(from, to, s) with s from 0 to 1.
struct Line {
  Pose from;
  Pose to;
};

/// A line that moves less than this for each radian that it turns, in metres, is told by its turn.
constexpr double least_metres_per_radian = 0.01;

/// The screw motion from one pose to the other, by a turn of at most pi: the tool's origin runs on
/// a helix about a fixed axis while the orientation takes the shortest turn.
struct ScrewLine {
  Pose from;
  Pose to;
};

/// An arc of a circle: the tool's origin turns about the axis through `centre` along `turn`, whose
/// length is the arc's angle, at most 2 pi, while the orientation takes the shortest turn from
/// `from` to `to`, both at a constant rate. See arc_through().
struct Arc {
  Pose from;
  Pose to;
  Vector3 centre;
  Vector3 turn;
};

/// A segment of a spline, and a rounded corner. With the vectors x and r of the polynomial
///     [x; r](s) = terms.col(0) + terms.col(1) s + ... + terms.col(5) s^5
/// in the world's axes, the position is that of `centre` plus x and the orientation so3_exp(r)
/// times that of `centre`. It is meant for |r| <= pi.
struct SplineSegment {
  Pose centre = Pose::Identity();
  Matrix6 terms = Matrix6::Zero();
};

/// What the tool does between two places; s from 0 to 1 is the share of it that is done.
using Segment = std::variant<Line, ScrewLine, Arc, SplineSegment>;

/// The arc through a position that it passes. Throws Error where the three positions do not tell a
/// circle: two of them are one, or all lie on a straight line but for 1e-6 of their distance.
Arc arc_through(const Pose& from, const Vector3& passed, const Pose& to);

Pose pose_at(const Segment& segment, double s);

/// A pose with its derivatives by s: velocity of the tool's origin and angular velocity, and the
/// rates of both, in the world's axes; metres and radians.
struct SegmentMotion {
  Pose pose;
  Twist velocity;
  Twist acceleration;
};
SegmentMotion motion_at(const Segment& segment, double s);

/// The way of the tool's origin, metres: exact but for splines, where it is a sum (Gauss-Legendre,
/// 80 points; about ten digits where the origin does not come to rest).
double length_of(const Segment& segment);

/// The segment gone from its end to its begin; one that turns by exactly pi may turn the other way.
Segment reversed(const Segment& segment);

/// The segment turns about the world's z axis alone, and so moves planar arms.
bool turns_about_z(const Segment& segment);

}  // namespace beeline
