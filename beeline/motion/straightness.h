#pragma once

#include <span>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

/// A straight line for the tool: interpolate(from, to, s) with s from 0 to 1.
struct Line {
  Pose from;
  Pose to;
};

/// How far `pose` is from the nearest point of the line: the distance to the segment and the turn
/// to the line's orientation at that point, as far as the task asks. Where the line only turns, the
/// nearest point is told by the turn.
Deviation deviation_from(const Line& line, const Pose& pose, const Task& task);

/// Proved bounds on how far the tool leaves the straight line between its own poses at q_a and q_b
/// while every joint moves in proportion from the one to the other; metres and radians.
///
/// Position: with p'' the tool's second derivative over that motion, the distance from the chord is
/// at most max |p''| / 8. For joints i up to j, d2p/dq_i dq_j = w_i x (w_j x r_j) is no longer than
/// the tool's distance from axis j, which grows by at most what the joints behind j move the tool.
/// Slides add their direction's turn by the joints before them.
/// Orientation: the angular velocity changes by at most A = sum over i < j of |dq_i dq_j|, so the
/// orientation leaves the shortest turn between its ends by at most (A/4) / cos(turn/4).
Deviation chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b);

/// How straight a joint motion is along the lines through waypoints, measured and proved.
struct Straightness {
  Deviation sampled;  ///< the largest deviation at the samples
  Deviation bound;    ///< proved: at no moment between samples, joints moving in proportion, more
};

/// `arrivals[w]` is the sample at which waypoint w is taken to be reached; the first line begins at
/// the first sample's own pose. Throws Error when sizes do not fit.
Straightness straightness(const Arm& arm, std::span<const Configuration> samples,
                          std::span<const Pose> waypoints, std::span<const std::size_t> arrivals,
                          const Task& task);

/// The bound for one step along a line, whose ends were measured to deviate by `a` and `b`.
Deviation step_bound(const Arm& arm, const Line& line, const Task& task,
                     const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                     const Deviation& b);

}  // namespace beeline
