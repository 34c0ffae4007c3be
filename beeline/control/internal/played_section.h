#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/control/internal/held_limits.h>
#include <beeline/control/internal/recorded_sections.h>
#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/averaged_scaling.h>

namespace beeline::internal {

/// A motion that is played: the lead-in or the recording. Columns are in the arm's order.
struct PlayedMotion {
  const Arm& arm;
  const Trajectory& recording;
  Interpolation interpolation;  ///< interpolation of the samples
  HeldLimits held;              ///< see held_limits()
  BudgetMeter& budget;
  std::vector<RecordedSection> sections = sections_between_stops(arm, recording);
  std::size_t first = 0;    ///< with a rate, the number of its first sample
  double max_slowdown = 2;  ///< max slowdown beyond whole periods

  double duration() const { return recording.times.back() - recording.times.front(); }
};

/// Samples of a played motion within the held limits, or the reason why there are none, such as the
/// end of the budget.
struct PlayedSection {
  Trajectory trajectory;  ///< times from 0
  double slowdown = 1;    ///< duration / requested duration
  Reason reason = {};
};

/// Plays a motion at a constant speed. Without a rate its samples are at whole nanoseconds along
/// the motion, with a rate at k / rate. Stops of the recording are samples. The sections between
/// them last whole nanoseconds or periods, and dwells last at least as long as recorded. The motion
/// is slowed down until the samples keep the limits; with a rate, each section by whole periods.
PlayedSection at_constant_speed(const PlayedMotion& motion, double speed, double rate);

/// Returns the recorded samples at this speed, slowed down further if there is no dwell. At another
/// speed than the recording's own, their times are rounded to whole nanoseconds along the motion,
/// unless they are too near to one another.
Trajectory recorded_samples(const PlayedMotion& motion, double speed, double slowdown);

/// Returns samples at the rate for a constant speed; see at_constant_speed().
PlayedSection in_periods(const PlayedMotion& motion, double speed, double rate);

/// Plays a motion with the speed changes of `options`, whose times are the times of the samples
/// `motion.first` / `rate` and later. All speeds are multiplied by a factor, and their rates of
/// change by its square, until the samples keep the limits.
PlayedSection with_speed_changes(const PlayedMotion& motion, const ReplayOptions& options,
                                 double rate);

/// Returns the samples at these times and this progress along the recording; none if the budget
/// ends. Samples at stops have the recorded values.
Trajectory samples_at(const PlayedMotion& motion, const std::vector<double>& times,
                      std::span<const ParameterState> progress);

/// Returns the time of sample k at a rate, in whole nanoseconds.
double time_at_rate(std::size_t k, double rate);

/// Returns times at the rate from 0, for a motion that begins at sample `first`.
std::vector<double> times_from(std::size_t first, std::size_t count, double rate);

/// Returns the reason for a budget that has ended.
PlayedSection ended_section(const PlayedMotion& motion);

/// Throws Error for more samples than a replay may have.
void check_samples(double samples, double duration, double rate);

}  // namespace beeline::internal
