#pragma once

#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/math/polynomial.h>
#include <beeline/model/arm.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// The motion of the joints between two samples, or in a part of that interval, along one segment:
/// polynomials of u from 0 to 1.
struct Interval {
  std::vector<Polynomial> coordinates;
  Polynomial s;  ///< the segment parameter for these coordinates
};

/// The part of the interval with u in [from, to].
Interval part(const Interval& interval, double from, double to);

/// The tool's projection on a line in a part of an interval. At u in [0, 1] of that part it is the
/// point of the line at the fraction s(u), below 0 and above 1 on its continuations, to within
/// `error`.
struct LineProjection {
  Polynomial s;
  double error = 0;
};

/// The deviation of the tool from the segment in an interval: `measured` at its ends and at the
/// points of division, and a proved bound at all times.
struct IntervalDeviation {
  Deviation measured, bound;
  /// The projections of all parts, in order, for a line by position whose position rows do not
  /// rotate with the tool; empty for other segments.
  std::vector<LineProjection> projections = {};
};

/// Let e(u) = tool(q(u)) - segment(s(u)), in the rows of the task; for orientations the difference
/// of the rotation matrices. The quintic polynomial H that has e's values and first two derivatives
/// at both ends satisfies
///     |e(u) - H(u)| <= max |e^(6)| / 46080,
/// and |H| is at most the largest of its Bernstein coefficients. The sixth derivatives of tool and
/// segment are bounded by tool_taylor_bound() and segment_taylor_bound(). Where the remainder
/// dominates, the interval is divided into halves: the remainder of a half is 1/64. The bound
/// includes the rounding errors of e, H and their derivatives (interval_rounding.h).
///
/// On a line by position only the component of e across the line counts, because the deviation is
/// measured from the nearest point. The component along the line turns the projection of s(u) into
/// the projection of the tool. An s(u) outside [0, 1] counts as the segment's end.
///
/// An interval is halved while its bound is above `already_reported`, a deviation that the caller
/// reports in any case, and
///   - the remainder dominates the bound, or
///   - the bound is above `goal`, the tolerance, and no measured deviation is, or
///   - the error of a projection is above a fraction of `goal`.
IntervalDeviation interval_deviation(const Arm& arm, const Segment& segment, const Task& task,
                                     const Interval& interval,
                                     const Deviation& already_reported = {},
                                     const Deviation& goal = {Limits::none, Limits::none});

}  // namespace beeline::internal
