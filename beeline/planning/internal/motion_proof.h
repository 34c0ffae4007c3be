#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/move_along.h>

namespace beeline::internal {

/// Proves the finished motion by verify(), and so by what finds faults in its file; refuses one
/// that is not proved. Its deviation is then that along the whole path, whatever verify() found
/// first; returns the interval between samples in which it found that.
std::size_t prove(const Arm& arm, const Route& route, const Task& task,
                  const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion);

/// How often each interval between samples is to be divided for its deviation to be proved: the
/// bound falls with the second power of the number for linear joints, with the sixth or the fourth
/// for others. The interval `faulty` is halved at least. Empty if that would exceed max_samples.
std::vector<int> divisions(const PathDeviation& deviation, std::size_t faulty,
                           const PathMotionOptions& options);

}  // namespace beeline::internal
