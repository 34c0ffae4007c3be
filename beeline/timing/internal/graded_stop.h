#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// The samples of a section whose joints move linearly between them: its time scaling and the path
/// parameters that get a sample, in order.
struct LinearSamples {
  const TimeScaling& scaling;
  std::vector<double>& required;
};

/// Adds samples next to the stop between two sections of linear joints, so that the intervals grow
/// from the shorter one at the stop by a factor of at most 2.
///
/// The velocity of linear joints changes at a sample, within the shorter of its two intervals (see
/// needed_derivative()). With the largest acceleration a, the mean velocities in the intervals h
/// before and H after a stop are at most a h / 2 and a H / 2, so that the stop may need
///
///     a (h + H) / (4 min(h, H)),
///
/// which is above a if one interval is more than three times the other. A short section beside a
/// long one has such intervals. A factor below 3 leaves room for sections that are slowed down.
void grade_stop(const LinearSamples& before, const LinearSamples& after, BudgetMeter& budget);

}  // namespace beeline::internal
