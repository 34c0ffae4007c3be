#pragma once

#include <span>
#include <vector>

#include <beeline/control/internal/recorded_sections.h>
#include <beeline/control/replay.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/averaged_scaling.h>

namespace beeline::internal {

/// The speeds of a replay at the samples of a rate.
struct SpeedSchedule {
  const ReplayOptions& options;
  double rate = 0;
  std::size_t first = 0;  ///< number of the first sample
  double scale = 1;       ///< factor on all speeds; the rates at which they change have its square
  std::span<const RecordedSection> sections;  ///< of the recording
  BudgetMeter& budget;
};

/// Returns the recording's time, with its derivatives by the time of playing, at each sample from
/// the motion's beginning to its end. The speed is linear between samples, and changes at most at
/// the rate of the ramp; less where the acceleration q'' s^2 + q' ds/dt of a joint would exceed its
/// limit, but at least a twentieth. It is averaged over a fifth of the ramp, so that the
/// acceleration is continuous. The speed starts at its first target where the motion starts at
/// rest, otherwise at zero. Each section is slowed down such that it ends at a sample. Returns what
/// was found where the budget ends. Throws Error for more samples than a replay may have.
std::vector<ParameterState> scheduled_progress(const Arm& arm, const Trajectory& recording,
                                               const SpeedSchedule& schedule);

}  // namespace beeline::internal
