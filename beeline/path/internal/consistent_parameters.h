#pragma once

#include <functional>
#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/internal/path_tracker.h>

namespace beeline::internal {

/// Assigns path parameters to the poses of samples: they do not decrease from one sample to the
/// next, and each pose is within the tolerance there. `first_within` are those by
/// PathTracker::first_within(), one after the other, the least that are possible; the first and the
/// last one are kept. Going back from the last, last_within() gives the largest that are possible.
/// Between the two the parameters are local minima of the distance, or as near after them as those
/// of earlier samples allow. Where there are several for a pose, because the path approaches
/// itself, they minimise, over all samples together,
///     sum d_k^2 + sum (l_k - m_k)^2,
/// d the distance from the path, l the length of the path between two samples, and m that of the
/// tool's motion, `moved(k)` from sample k to the next. Takes time in proportion to the number of
/// samples; where the budget ends it, returns `first_within`.
std::vector<double> consistent_parameters(const PathTracker& tracker, std::span<const Pose> poses,
                                          const std::vector<double>& first_within,
                                          const std::function<double(std::size_t)>& moved,
                                          BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
