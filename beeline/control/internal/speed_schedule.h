#pragma once

#include <span>
#include <vector>

#include <beeline/control/internal/recorded_sections.h>
#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/averaged_scaling.h>

namespace beeline::internal {

/// The speed schedule of a replay that is sampled at a rate.
struct SpeedSchedule {
  const ReplayOptions& options;
  double rate = 0;
  std::size_t first = 0;  ///< number of the first sample
  double scale = 1;  ///< factor on all speeds; their rates of change are multiplied by its square
  std::span<const RecordedSection> sections;  ///< sections of the recording
  BudgetMeter& budget;
};

/// Returns the recording's time, with its derivatives by the playing time, at each sample from the
/// motion's beginning to its end. The speed is linear between samples and changes at most at the
/// rate of the ramp. It changes less if the acceleration q'' s^2 + q' ds/dt of a joint would exceed
/// its limit, but at least at a twentieth of that rate. It is averaged over a fifth of the ramp, so
/// that the acceleration is continuous. The speed starts at its first target if the motion starts
/// at rest, otherwise at zero. Each section is slowed down so that it ends at a sample. If the
/// budget ends, returns the samples found so far. Throws Error for more samples than a replay may
/// have.
std::vector<ParameterState> scheduled_progress(const Arm& arm, const Trajectory& recording,
                                               const SpeedSchedule& schedule);

}  // namespace beeline::internal
