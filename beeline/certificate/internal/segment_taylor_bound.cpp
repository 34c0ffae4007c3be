#include <cmath>

#include <beeline/certificate/internal/segment_taylor_bound.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>

namespace beeline::internal {
namespace {

/// Bounds of a motion about a fixed axis at constant angular velocity `rate` (a line for 0), whose
/// origin has this velocity and acceleration: |p^(n)| = |p''| rate^(n - 2).
TaylorBound uniform_motion(const PoseMotion& motion, double rate) {
  TaylorBound bound;
  bound.c[1] = motion.velocity.head<3>().norm();
  double c = motion.acceleration.head<3>().norm();
  for (std::size_t n = 2; n < TaylorBound::terms; ++n) {
    c /= static_cast<double>(n);
    bound.c[n] = c;
    c *= rate;
  }
  return bound;
}

/// Bounds of the vector of three polynomials, rows `first` and the next two of the terms.
TaylorBound polynomial_bound(const Matrix6& terms, int first, double from, double to) {
  TaylorBound square;
  for (int row = first; row < first + 3; ++row) {
    Polynomial p;
    for (int k = 0; k < 6; ++k) p.c[static_cast<std::size_t>(k)] = terms(row, k);
    const TaylorBound bound = taylor_bound(p, from, to);
    for (std::size_t n = 0; n < TaylorBound::terms; ++n) square.c[n] += bound.c[n] * bound.c[n];
  }
  for (double& c : square.c) c = std::sqrt(c);
  return square;
}

SegmentTaylorBound taylor_bound_of(const Line& line, double, double) {
  SegmentTaylorBound bound;
  const Twist difference = pose_difference(line.to, line.from);
  bound.position.c[1] = difference.head<3>().norm();
  bound.rotation.c[1] = difference.tail<3>().norm();
  return bound;
}

SegmentTaylorBound uniform_bound(const PoseMotion& begin, double rate) {
  SegmentTaylorBound bound{uniform_motion(begin, rate), {}};
  bound.rotation.c[1] = begin.velocity.tail<3>().norm();
  return bound;
}

SegmentTaylorBound taylor_bound_of(const ScrewLine& screw, double, double) {
  const PoseMotion begin = motion_at(screw, 0);
  return uniform_bound(begin, begin.velocity.tail<3>().norm());
}

SegmentTaylorBound taylor_bound_of(const Arc& arc, double, double) {
  return uniform_bound(motion_at(arc, 0), arc.rotation.norm());
}

SegmentTaylorBound taylor_bound_of(const SplineSegment& segment, double from, double to) {
  return {polynomial_bound(segment.terms, 0, from, to),
          polynomial_bound(segment.terms, 3, from, to)};
}

}  // namespace

SegmentTaylorBound segment_taylor_bound(const Segment& segment, double from, double to) {
  return std::visit([&](const auto& kind) { return taylor_bound_of(kind, from, to); }, segment);
}

}  // namespace beeline::internal
