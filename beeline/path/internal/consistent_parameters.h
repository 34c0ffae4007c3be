#pragma once

#include <functional>
#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/internal/path_tracker.h>

namespace beeline::internal {

/// Assigns path parameters to the poses of samples. They do not decrease from one sample to the
/// next, and each pose is within the tolerance at its parameter. `first_within` has the least
/// possible parameters, computed by PathTracker::first_within() for one sample after the other; the
/// first and the last one are kept. Backwards from the last sample, last_within() gives the largest
/// possible parameters. Between the two the parameters are local minima of the distance, or as near
/// after them as the parameters of earlier samples allow. If there are several for a pose, because
/// the path approaches itself, they minimise, over all samples together,
///     sum d_k^2 + sum (l_k - m_k)^2,
/// with the distance d from the path, the length l of the path between two samples, and the length
/// m of the tool's motion, `moved(k)` from sample k to the next. Takes time in proportion to the
/// number of samples. Returns `first_within` if the budget ends the computation.
std::vector<double> consistent_parameters(const PathTracker& tracker, std::span<const Pose> poses,
                                          const std::vector<double>& first_within,
                                          const std::function<double(std::size_t)>& moved,
                                          BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
