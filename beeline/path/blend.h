#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// How a corner of lines is blended. Lengths count as in span_of().
struct Blend {
  double radius = 0;  ///< of each of the two lines, what is cut off at the corner; 0: not blended
  bool shortened = false;  ///< less than the distances allow: the lines are too short for more
  bool sharp = false;      ///< the tool turns back, which cannot be blended: it has to stop there
  /// Most that the rounding is off the two lines: from the nearest point by position, at which the
  /// orientation is compared, where both lines move; else from the same share of the way.
  Deviation line_deviation;
  Deviation corner_deviation;  ///< how far from the corner's pose it passes, half-way
  double curvature = 0;        ///< of the tool's way, most; 1/m
};

/// Lines with blended corners: segments are what is left of the lines, and between them
/// SplineSegments.
struct BlendedPath {
  ToolPath path;              ///< velocity and acceleration continuous, but for sharp corners
  std::vector<bool> stops;    ///< after each segment: at sharp corners alone
  std::vector<Blend> blends;  ///< one for each pose between the first and the last
};

/// Lines through the poses with corners blended: at half-way the rounding passes each pose within
/// `within`, and so never leaves the lines by more than Blend::line_deviation, which is within it
/// too. With the vectors `in` and `out`, which lead from its begin on the one line to the corner
/// and from there to its end on the other, position and turn, it is
///     x(s) = -f(1 - s) in + f(s) out,   f(s) = 2 s^3 - s^4
/// from the corner, the turn taken as a rotation vector: reversal makes the same path. Roundings do
/// not overlap: each has half of a line at least, or what its neighbour leaves.
/// Throws Error for fewer than two poses, one that is not a rigid motion or repeats the one before
/// it, and distances that are not positive.
BlendedPath blended_lines(std::span<const Pose> poses, const Deviation& within);

/// The tool stops at sharp corners only.
Route route_of(const BlendedPath& blended);

}  // namespace beeline
