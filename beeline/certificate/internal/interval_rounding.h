#pragma once

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/certificate/internal/segment_taylor_bound.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Bounds of the rounding errors in the values from which interval_deviation() computes a bound, in
/// double precision rounded to nearest, with e = 2^-52.
///
/// Each of n joints multiplies the pose by a rotation that is wrong by 24 e, and by the error of
/// its angle: a coordinate sum_k c_k u^k is evaluated to within 8 e sum_k (1 + 2 k^2) |c_k|. With L
/// the sum of all lengths that the arm's description has, the tool's origin is wrong by at most a
/// relative error times L, and its derivatives by as much times theirs. The same holds for the pose
/// of the segment, with the size of its numbers for L. The bound for an interval holds for its
/// parts. The constants are derived in interval_rounding.cpp; they assume that the sine and the
/// cosine of the C library are wrong by less than a unit in the last place.
class IntervalRounding {
 public:
  IntervalRounding(const Arm& arm, const Segment& segment, const Task& task);

  /// Returns the errors of a position and of a chord between rotations, m and rad, for an interval
  /// with these bounds of its segment.
  Deviation error_bounds(const Interval& interval, const SegmentTaylorBound& bound) const;

 private:
  const Arm& arm_;
  bool tool_axes_;            ///< whether positions are in the tool's axes
  double arm_length_ = 0;     ///< lengths that do not depend on the configuration, m
  double segment_size_ = 0;   ///< of the numbers that a position of the segment is the sum of, m
  double segment_angle_ = 0;  ///< likewise, of its rotation vector, rad
};

}  // namespace beeline::internal
