#pragma once

#include <span>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// Deviation of a joint motion from its path, the joints moving linearly between samples; metres
/// and radians. sampled <= measured <= bound.
struct PathDeviation {
  Deviation sampled;   ///< largest deviation at the samples
  Deviation measured;  ///< largest deviation at the samples and half-way between them
  Deviation bound;     ///< proved upper bound at all times
};

/// Measures and bounds the deviation of the samples from the path. `path_parameters[k]` is the path
/// parameter of sample k: whole segments, with a fraction of the next. On a line the deviation is
/// from its nearest point, whatever the fraction; verify() also checks that each line is traversed
/// to its end.
/// Throws Error when sizes do not fit, the path parameters are not on the path or decrease, or the
/// task leaves rows free that the path's segments need (see PathMotionOptions::task).
PathDeviation path_deviation(const Arm& arm, std::span<const Configuration> samples,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task);

/// Computes the path parameters of samples along the path; sample `arrivals[i]` is at the end of
/// segment i. Samples between two of these get the parameter of the nearest point, and those after
/// the last one its segment's end. Throws Error when the arrivals are not indices of samples in
/// order, or more than segments.
std::vector<double> path_parameters_along(const Arm& arm, std::span<const Configuration> samples,
                                          const ToolPath& path,
                                          std::span<const std::size_t> arrivals, const Task& task);

/// Returns the index of the first sample at or after the end of each segment, for the segments
/// whose end the path parameters reach.
std::vector<std::size_t> arrivals(std::span<const double> path_parameters);

}  // namespace beeline
