#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/control/internal/held_limits.h>
#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/averaged_scaling.h>

namespace beeline::internal {

/// A motion from rest to rest that is played: the lead-in or the recording. Columns are in the
/// arm's order.
struct PlayedMotion {
  const Arm& arm;
  const Trajectory& recording;
  Interpolation interpolation;  ///< of the samples
  HeldLimits held;              ///< see held_limits()
  std::size_t first = 0;        ///< number of the sample at which it begins, with a rate
  BudgetMeter* budget = nullptr;
};

/// Samples of a played motion within the held limits, or the reason why there are none, such as the
/// end of the budget.
struct PlayedSection {
  Trajectory trajectory;  ///< times from 0
  double slowdown = 1;    ///< the duration as a multiple of that which was asked for
  std::string reason;
};

/// Plays a motion at a constant speed: its samples at whole nanoseconds along the motion or, with a
/// rate, samples at k / rate. The whole is slowed down, with a rate by whole periods, until the
/// samples hold the limits.
PlayedSection at_constant_speed(const PlayedMotion& motion, double speed, double rate);

/// Plays a motion with the speed changes of `options`, whose times are those of the samples
/// `motion.first` / `rate` and later. All speeds are multiplied by a factor, and the rates at which
/// they change by its square, until the samples hold the limits.
PlayedSection with_speed_changes(const PlayedMotion& motion, const ReplayOptions& options,
                                 double rate);

/// The time of sample k at a rate, in whole nanoseconds.
double time_at_rate(std::size_t k, double rate);

/// Throws Error for more samples than a replay may have.
void check_samples(double samples, double duration, double rate);

}  // namespace beeline::internal
