#pragma once

#include <beeline/planning/branch.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

struct TimedPlan {
  MotionStatus status = MotionStatus::reached;
  std::string reason = {};                   ///< unless reached
  Trajectory trajectory = {};                ///< from rest to rest
  std::vector<double> path_parameters = {};  ///< of each sample
};

/// Retimes a complete branch along the route's path from stop to stop by append_retimed(). Keeps
/// its samples or, with options.rate, takes samples at equal times and moves each onto the path at
/// the nearest path parameter.
TimedPlan time_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                    const RetimeOptions& options);

}  // namespace beeline::internal
