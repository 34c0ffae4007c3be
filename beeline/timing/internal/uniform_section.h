#pragma once

#include <functional>

#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {

/// sample_section() with a rate: the samples with the fewest periods within limits.
///
/// Slows the time scaling down to whole periods with d2s/dt2 constant between samples, then takes
/// its moving average over a whole number of periods. s(t) is then a cubic between two samples,
/// with d2s/dt2 continuous. The joints' polynomials agree with q(s(t)) at the samples, and
/// needed_slowdown() checks them between these.
SampledSection uniform_section(const Arm& arm, const TimedSection& section,
                               const SectionOptions& options);

/// The same, as short as its time scaling allows, whatever limits it exceeds.
SampledSection shortest_uniform_section(const Arm& arm, const TimedSection& section,
                                        const SectionOptions& options);

/// Returns the time scaling from rest at s = 0 to rest at `length` in this number of periods. The
/// speed is linear between the values `speed(k period)`, scaled so that s ends at `length`.
TimeScaling uniform_scaling(double periods, double period, double length,
                            const std::function<double(double)>& speed);

}  // namespace beeline::internal
