#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Plans the motion from rest to rest, straight in joint space, from a configuration outside the
/// position limits to the nearest one within them, as quickly as retime() allows. The joints that
/// are within their limits stand still; the others move in proportion by a time scaling that does
/// not decrease, so that their excess does not rise. The options' duration and blends do not count.
Retimed recovery_section(const Arm& arm, const Configuration& start, const RetimeOptions& options,
                         BudgetMeter& budget);

/// The max samples of a motion behind its recovery, which share a sample.
struct SamplesBehind {
  int max_samples = 0;
  Reason reason = {};  ///< why there is none: the recovery alone has as many
};

/// Returns the max samples behind a recovery if both have `max_samples` at most.
SamplesBehind samples_behind(const Trajectory& recovery, int max_samples);

/// Sets the max samples in a reason about the motion behind a recovery to the maximum of both.
void set_max_samples(int max_samples, Reason& reason);

/// Puts a recovery section before the motion that begins at its end, at rest, with the same
/// columns.
void put_before(const Trajectory& section, Trajectory& motion);

}  // namespace beeline::internal
