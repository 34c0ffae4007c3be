#pragma once

#include <span>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// Deviation of a joint motion from its path; metres and radians. sampled <= measured <= bound.
struct PathDeviation {
  Deviation sampled;   ///< largest deviation at the samples
  Deviation measured;  ///< largest deviation at the samples and at some times between them
  Deviation bound;     ///< proved upper bound at all times
  std::vector<Deviation> interval_bounds;  ///< proved from sample k to the next
  Ending ending = Ending::complete;        ///< otherwise `bound` is infinite
};

/// Measures and bounds the deviation of a trajectory, whose columns are in the arm's order, from
/// the path, for the motion that the columns mean (see Interpolation). `path_parameters[k]` is the
/// path parameter of sample k: whole segments, with a fraction of the next. On a line the deviation
/// is from its nearest point, whatever the fraction; verify() also checks that each line is
/// traversed to its end.
///
/// Between two samples the error's quintic Hermite polynomial is compared with the error itself by
/// a bound on the sixth derivative (certificate/internal/interval_deviation.h): for samples on the
/// path that have its velocity and acceleration, the bound falls with the sixth power of the time
/// between them.
///
/// Throws Error when sizes do not fit, the path parameters are not on the path or decrease, or the
/// task leaves rows free that the path's segments need (see PathMotionOptions::task).
PathDeviation path_deviation(const Arm& arm, const Trajectory& trajectory,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task, const Budget& budget = {});

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
