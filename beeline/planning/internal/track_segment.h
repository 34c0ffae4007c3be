#pragma once

#include <functional>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/planning/branch.h>

namespace beeline::internal {

/// Max deviation of the tool at the start from the segment's beginning, metres and radians: 1e-8,
/// the rounding of a configuration typed with nine digits, for an arm of 1 m reach.
double start_tolerance(const Arm& arm);

struct TrackOptions {
  Deviation tolerance = {};  ///< of step_bound(), between samples
  std::size_t max_samples = 0;
  double begin = 0;  ///< the fraction at which the tool is at the start, below 1
  /// Returns the initial guess at a fraction of the segment. Default, also for an empty guess:
  /// predict_configuration().
  std::function<Configuration(double)> guide = {};
  std::function<void(double)> progress =
      {};                             ///< called repeatedly with the fraction tracked so far
  BudgetMeter& budget = unlimited();  ///< asked before each step; default: none
};

/// Tracks the segment from `start`, whose tool is at options.begin, and returns the samples. Each
/// sample is solved to rounding within the bounds. step_bound() bounds the deviation between two
/// samples by the tolerance, so no change of branch can occur between them; verify() proves the
/// motion that is made of them. Steps are as long as this bound allows. At a singular start, the
/// first joint that can move to either side determines the direction. Returns early if no
/// configuration continues the motion, at max_samples, and if the budget ends. Throws Error for a
/// start whose tool is not at options.begin, and for a task that the segment does not allow.
TrackedSegment track_segment(const Arm& arm, const Segment& segment, const Task& task,
                             const internal::Bounds& bounds, const Configuration& start,
                             const TrackOptions& options);

}  // namespace beeline::internal
