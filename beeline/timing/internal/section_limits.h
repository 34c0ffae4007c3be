#pragma once

#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {

/// The factors by which the samples of a section must be slowed down to keep all limits, known and
/// assumed, except the jerk limits of a profile that does not keep them. Infinite if the budget of
/// the options has ended.
struct NeededSlowdown {
  double speed = 0;  ///< for velocities, accelerations and the tool's speed
  double jerk = 0;

  double both() const { return speed > jerk ? speed : jerk; }
};
NeededSlowdown needed_slowdown(const Arm& arm, const Trajectory& trajectory,
                               const SectionOptions& options);

/// The same for samples of a section, which keep several limits of the tool's speed along the path
/// too.
NeededSlowdown needed_slowdown(const Arm& arm, const SampledSection& samples,
                               const SectionOptions& options);

/// Lowers the path's limits at each place where samples of its time scaling, not slowed down,
/// exceed the limits of the arm or of the tool's speed: the speed limit, or the fraction of
/// acceleration and jerk if the scaling is smooth. Returns whether there are such places.
bool lower_limits(const Arm& arm, const SampledSection& samples, const SectionOptions& options,
                  TimedSection& section);

}  // namespace beeline::internal
