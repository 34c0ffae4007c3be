#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// How much one coordinate differs between two recordings.
struct JointDifference {
  double largest = 0;  ///< radians or metres
  double time = 0;     ///< when, seconds from both begins
  double rms = 0;      ///< over the time that both have
};

struct TrajectoryDifference {
  std::vector<JointDifference> joints;  ///< one for each coordinate
  double largest_position = 0;          ///< of the tool, metres
  double position_time = 0;
  double largest_orientation = 0;  ///< of the tool, radians
  double orientation_time = 0;
  double overlap = 0;  ///< seconds that both last
  double longer = 0;   ///< seconds by which `b` lasts longer; negative: shorter
};

/// Compares two recordings of an arm, each from its own first sample on, joints linear between
/// samples: at all samples of both. What a joint differs by at most is exact; the tool's
/// differences are those at the samples. Throws Error when one of them does not fit the arm or has
/// no samples.
TrajectoryDifference difference(const Arm& arm, const Trajectory& a, const Trajectory& b);

}  // namespace beeline
