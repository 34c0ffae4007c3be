#pragma once

#include <beeline/error.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The difference of one coordinate between two trajectories.
struct JointDifference {
  double largest = 0;  ///< radians or metres
  double time = 0;     ///< of the largest difference, seconds from the first samples
  double rms = 0;      ///< root mean square over the common duration
};

struct TrajectoryDifference {
  std::vector<JointDifference> joints;  ///< one for each coordinate
  double largest_position = 0;          ///< distance between the tools, metres
  double position_time = 0;             ///< seconds
  double largest_orientation = 0;       ///< angle between the tools, radians
  double orientation_time = 0;          ///< seconds
  double overlap = 0;                   ///< common duration, seconds
  double longer = 0;                    ///< duration of b minus that of a, seconds
};

/// Compares two trajectories of an arm, each from its own first sample on, joints linear between
/// samples, at the samples of both. A continuous joint of b begins within half a revolution of that
/// of a: whole revolutions do not count. The joints' largest differences are exact; those of the
/// tool are the largest at the samples. Throws Error when one of them does not fit the arm or has
/// no samples.
TrajectoryDifference difference(const Arm& arm, const Trajectory& a, const Trajectory& b);

}  // namespace beeline
