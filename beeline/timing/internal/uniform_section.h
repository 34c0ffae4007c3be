#pragma once

#include <beeline/timing/internal/section.h>

namespace beeline::internal {

/// sample_section() with a rate.
///
/// The time scaling is replaced by one whose d2s/dt2 is constant between samples, slowed down to
/// whole periods, and that by its moving average over a whole number of periods: s(t) then is a
/// cubic between two samples, with d2s/dt2 continuous. The joints' polynomials agree with q(s(t))
/// at the samples, and needed_slowdown() checks them between these.
SampledSection uniform_section(const Arm& arm, const TimedPath& section,
                               const SectionOptions& options);

/// The same, as short as its time scaling allows, whatever limits it exceeds.
SampledSection shortest_uniform_section(const Arm& arm, const TimedPath& section,
                                        const SectionOptions& options);

/// The time scaling from s = 0 to `length` with these speeds at k times the period, linear between
/// them, scaled such that it ends there.
TimeScaling uniform_scaling(const std::vector<double>& speeds, double period, double length);

}  // namespace beeline::internal
