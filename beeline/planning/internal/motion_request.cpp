#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

BranchOptions branch_options(const Arm& arm, const PathMotionOptions& options, double tolerated) {
  return {.task = options.task.value_or(default_task(arm)),
          .tolerance = {tolerated * options.tolerance, tolerated * options.orientation_tolerance},
          .max_samples = static_cast<std::size_t>(options.max_samples)};
}

RetimeOptions timing_options(const PathMotionOptions& options) {
  return {.profile = options.profile,
          .interpolation = options.interpolation,
          .tool_speed = options.tool_speed,
          .rate = options.rate,
          .duration = options.duration,
          .max_samples = options.max_samples};
}

FreeMotionOptions free_motion_options(const PathMotionOptions& options) {
  return {.profile = options.profile,
          .interpolation = options.interpolation,
          .tool_speed = options.tool_speed,
          .rate = options.rate,
          .max_samples = options.max_samples,
          .budget = options.budget};
}

VerifyOptions proof_options(const PathMotionOptions& options) {
  return {.task = options.task,
          .tolerance = options.tolerance,
          .orientation_tolerance = options.orientation_tolerance};
}

ClearanceOptions clearance_options(const PathMotionOptions& options) {
  return {.recover_clearance = options.recover_clearance};
}

}  // namespace beeline::internal
