#include <beeline/control/internal/command_interpolation.h>

namespace beeline::internal {

CommandInterpolation::CommandInterpolation(const Pose& world_T_tool, double time_step,
                                           double period)
    : current_(world_T_tool), commanded_(world_T_tool), time_step_(time_step), period_(period) {}

const Pose& CommandInterpolation::step(const Pose& commanded) {
  constexpr double rounding = 1e-9;  // tolerance of the steps' sum, relative to one step
  if (commanded.matrix() != commanded_.matrix()) {
    commanded_ = commanded;
    remaining_ = period_;
  }
  if (remaining_ > (1 + rounding) * time_step_) {
    current_ = interpolate(current_, commanded_, time_step_ / remaining_);
    remaining_ -= time_step_;
  } else {
    current_ = commanded_;
  }
  return current_;
}

}  // namespace beeline::internal
