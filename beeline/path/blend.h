#pragma once

#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// The blend of the corner between two lines. Lengths are measured as by span_of().
struct Blend {
  double radius = 0;  ///< length of the part of each line that the blend replaces, m; 0: no blend
  /// Whether the lines are too short for the radius that the tolerances allow.
  bool shortened = false;
  /// Whether the tool's direction reverses: there is no blend, and the tool stops.
  bool sharp = false;
  /// Largest deviation from the two lines. If both lines translate, the blend is compared with the
  /// nearest point by position, otherwise with the pose at the same fraction.
  Deviation line_deviation;
  Deviation corner_deviation;  ///< distance from the corner's pose at s = 1/2
  double curvature = 0;        ///< largest curvature of the path of the tool origin, 1/m
};

/// Lines with blended corners: the segments are the parts of the lines that remain, and the blends
/// between them.
struct BlendedPath {
  /// Twice continuously differentiable except where the tool stops. Messages name its segments
  /// `line 2 of 5 (pose 2 to 3)` and `the blend at pose 3`.
  ToolPath path;
  std::vector<bool> stops;    ///< whether the tool stops after each segment but the last
  std::vector<Blend> blends;  ///< one blend for each pose between the first and the last
  /// Of each segment: the number, from 0, of its line, or of the line before its blend.
  std::vector<std::size_t> lines;
};

/// Returns the lines through the poses (world_T_tool) with blended corners. At s = 1/2 a blend
/// passes its corner's pose within `within`; Blend::line_deviation is within it too. Let `in` and
/// `out` be the vectors (position and rotation vector) from the beginning of the blend on the first
/// line to the corner, and from the corner to its end on the second line. Relative to the corner
/// the blend is
///     x(s) = -f(1 - s) in + f(s) out,   f(s) = 2 s^3 - s^4,
/// so poses in reverse order give the reversed path. A sixteenth of each line at least stays
/// straight: each of its two blends may use half of the rest, or more if the other uses less. The
/// tool stops at sharp corners only. Consecutive poses within 1e-5 m and rad of each other are
/// passed as one, within the smallest of their tolerances: the last of them has the blend, and the
/// lines between them have no segment. Throws Error for fewer than two different poses, a pose that
/// is not a rigid motion, and tolerances below 1e-4 m or rad.
BlendedPath blended_lines(std::span<const Pose> poses, const Deviation& within);

/// The same with tolerances for each pose between the first and the last. Throws Error for another
/// number of them.
BlendedPath blended_lines(std::span<const Pose> poses, std::span<const Deviation> within);

/// The names and numbers of the poses of a path in messages.
struct PoseNumbers {
  std::string noun = "pose";
  bool start_first = false;  ///< the first pose is "start", and the next one has number 1
};

/// Names the segments of blended lines by the poses between which they are: "line 2 of 5 (pose 2 to
/// 3)" and "the blend at pose 3".
std::vector<std::string> blend_names(const BlendedPath& blended, const PoseNumbers& numbers = {});

/// The route along the path, with its stops.
Route route_of(const BlendedPath& blended);

}  // namespace beeline
