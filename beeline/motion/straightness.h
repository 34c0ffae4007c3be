#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/motion/path/piece.h>

namespace beeline {

/// How far `pose` is from the nearest point of the line: the distance to the segment and the turn
/// to the line's orientation at that point, as far as the task asks. Nearest is meant by position;
/// by orientation where the line moves less than `way_of_a_radian`.
Deviation deviation_from(const Line& line, const Pose& pose, const Task& task);

/// The line's pose at that point.
Pose nearest_on(const Line& line, const Pose& pose, const Task& task);

/// A bound on deviation_from(line, ..., task) while every joint moves in proportion from q_a to
/// q_b, at whose ends it was measured to be `a` and `b`. From chord_bound(), so it falls with the
/// square of the step; but only with the step itself where the task leaves two of the orientation
/// rows free, or some position rows in the tool's axes, for there the rows that matter turn. Throws
/// Error when q_a or q_b does not fit the arm.
Deviation step_bound(const Arm& arm, const Line& line, const Task& task,
                     const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                     const Deviation& b);

/// A step measured half-way, and its bound with that known: the lesser of step_bound() and the
/// larger of both halves' own, where what the bound cannot tell of a step is an eighth.
struct HalvedStep {
  Deviation middle;
  Deviation bound;
};
HalvedStep halved_step(const Arm& arm, const Line& line, const Task& task,
                       const ConfigurationRef& q_a, const ConfigurationRef& q_b, const Deviation& a,
                       const Deviation& b);

/// Makes `largest` no less than what was met.
inline void grow(Deviation& largest, const Deviation& met) {
  largest.position = std::max(largest.position, met.position);
  largest.orientation = std::max(largest.orientation, met.orientation);
}

/// How straight a joint motion is along the lines through waypoints, measured and proved.
struct Straightness {
  Deviation sampled;   ///< the largest deviation at the samples
  Deviation measured;  ///< at the samples and at places between them
  Deviation bound;     ///< proved: at no moment between samples, joints moving in proportion, more
};

/// `arrivals[w]` is the sample at which waypoint w is taken to be reached; the first line begins at
/// the first sample's own pose. Throws Error when sizes do not fit.
Straightness straightness(const Arm& arm, std::span<const Configuration> samples,
                          std::span<const Pose> waypoints, std::span<const std::size_t> arrivals,
                          const Task& task);

}  // namespace beeline
