#pragma once

#include <beeline/planning/branch.h>
#include <beeline/timing/retime.h>

namespace beeline {

/// A planned way with its times.
struct TimedPlan {
  MotionStatus status = MotionStatus::reached;
  std::string reason = {};                   ///< why there is none; empty when reached
  Trajectory trajectory = {};                ///< from rest to rest
  std::vector<double> path_parameters = {};  ///< on the path, of each sample
};

/// Gives a branch that goes all along the route's path its times, from stop to stop
/// (append_timed()): its own samples, or, with a rate, samples at equal times, each brought onto
/// the path where the tool is nearest.
TimedPlan timed_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                     const RetimeOptions& options);

}  // namespace beeline
