#pragma once

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Distributes each change of a commanded pose equally among the steps of a period: see
/// TrackerOptions::command_period.
class CommandInterpolation {
 public:
  /// Starts at `world_T_tool`. Times in seconds; a period up to one time step changes nothing.
  CommandInterpolation(const Pose& world_T_tool, double time_step, double period);

  /// Advances by one time step towards the commanded pose.
  const Pose& step(const Pose& commanded);

 private:
  Pose current_, commanded_;
  double time_step_, period_;
  double remaining_ = 0;  ///< time until the commanded pose, seconds
};

}  // namespace beeline::internal
