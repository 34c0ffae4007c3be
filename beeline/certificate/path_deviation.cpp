#include <algorithm>
#include <limits>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_interval.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/path_tracker.h>
#include <beeline/trajectory/internal/mean_derivative.h>

namespace beeline {

using namespace internal;

PathDeviation path_deviation(const Arm& arm, const Trajectory& trajectory,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task, const Budget& budget) {
  if (trajectory.size() == 0 || trajectory.size() != path_parameters.size()) {
    throw Error("path_deviation needs samples and a path parameter for each, not " +
                std::to_string(trajectory.size()) + " samples and " +
                std::to_string(path_parameters.size()) + " path parameters");
  }
  check_fits(arm, trajectory);
  internal::check_task(arm, path, task);
  check_path_parameters(path, path_parameters);
  BudgetMeter meter(budget);
  PathDeviation result;
  result.bound = {};
  for (std::size_t k = 0; k < trajectory.size() && !meter.ended(); ++k) {
    const Pose pose = forward_kinematics(arm, trajectory.positions[k]);
    grow(result.sampled, deviation_from(path, path_parameters[k], pose, task));
  }
  result.measured = result.sampled;
  for (std::size_t k = 1; k < trajectory.size() && !meter.ended(); ++k) {
    result.interval_bounds.emplace_back();
    for (const PathInterval& part : path_intervals(arm, trajectory, k - 1, path, task,
                                                   path_parameters[k - 1], path_parameters[k])) {
      const IntervalDeviation here = interval_deviation(arm, path.segments[part.segment], task,
                                                        part.interval, result.measured);
      grow(result.measured, here.measured);
      grow(result.interval_bounds.back(), here.bound);
    }
    grow(result.bound, result.interval_bounds.back());
  }
  grow(result.bound, result.measured);
  result.ending = meter.ending();
  if (result.ending != Ending::complete) result.bound = no_bound;
  return result;
}

std::vector<double> path_parameters_along(const Arm& arm, std::span<const Configuration> samples,
                                          const ToolPath& path,
                                          std::span<const std::size_t> arrivals, const Task& task) {
  if (samples.empty() || arrivals.size() > path.segments.size()) {
    throw Error("path parameters need samples, and at most as many arrivals as segments; given " +
                std::to_string(samples.size()) + " samples and " + std::to_string(arrivals.size()) +
                " arrivals for " + std::to_string(path.segments.size()) + " segments");
  }
  constexpr Deviation fine{1e-4, 1e-4};  // max size of the cells of the path
  std::vector<double> path_parameters{0};
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const auto end = static_cast<double>(i + 1);
    if (arrivals[i] + 1 < path_parameters.size() || arrivals[i] >= samples.size()) {
      throw Error("arrival " + std::to_string(i + 1) + " is sample " + std::to_string(arrivals[i]) +
                  "; arrivals are indices of the " + std::to_string(samples.size()) +
                  " samples, in order");
    }
    const PathTracker tracker(path, task, end - 1, end, fine);
    for (std::size_t k = path_parameters.size(); k <= arrivals[i]; ++k) {
      const Pose pose = forward_kinematics(arm, samples[k]);
      path_parameters.push_back(tracker.nearest(pose, std::max(path_parameters.back(), end - 1)));
    }
    path_parameters.back() = end;
  }
  path_parameters.resize(samples.size(), path_parameters.back());
  return path_parameters;
}

std::vector<std::size_t> arrivals(std::span<const double> path_parameters) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < path_parameters.size(); ++k) {
    while (path_parameters[k] >= static_cast<double>(all.size() + 1)) all.push_back(k);
  }
  return all;
}

}  // namespace beeline
