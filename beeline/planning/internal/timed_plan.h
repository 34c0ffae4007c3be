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

/// Times a complete branch along the route's path from stop to stop (timing/internal/section.h).
/// `tolerance`: the joint path through the branch's samples leaves the tool path by about so much
/// at most. `longest_gap`: between two samples, as a fraction of a section's duration; of that with
/// as many samples as the branch for linear joints, whose samples are at equal times.
TimedPlan time_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                    const Deviation& tolerance, const RetimeOptions& options,
                    double longest_gap = 1);

}  // namespace beeline::internal
