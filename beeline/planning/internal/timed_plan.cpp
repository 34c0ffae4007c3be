#include <algorithm>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_parameter.h>
#include <beeline/path/joint_path.h>
#include <beeline/planning/internal/retime_samples.h>
#include <beeline/planning/internal/timed_plan.h>

namespace beeline::internal {
namespace {

/// The samples from one stop to the next.
struct Section {
  std::vector<Configuration> samples;
  std::vector<double> path_parameters;
};

/// Moves samples at equal times onto the path, except the first and the last, and returns their
/// path parameters. They are on the spline through the section's exact samples, `arc_lengths` along
/// the polyline of these.
std::vector<double> move_onto_path(const Arm& arm, const ToolPath& path, const Task& task,
                                   const Section& exact, std::span<const double> arc_lengths,
                                   Trajectory& timed) {
  const Bounds bounds = bounds_of(arm);
  const std::vector<double> lengths = chord_length(exact.samples);
  std::vector<double> path_parameters{exact.path_parameters.front()};
  for (std::size_t k = 1; k + 1 < timed.size(); ++k) {
    const auto next = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, arc_lengths[k]);
    const auto i = static_cast<std::size_t>(next - lengths.begin());
    const double from = std::max(exact.path_parameters[i - 1], path_parameters.back());
    const double to = exact.path_parameters[i];
    Configuration& q = timed.positions[k];
    const double s = nearest_parameter(path, task, forward_kinematics(arm, q), from, to);
    path_parameters.push_back(s);
    const NumericalResult found = levenberg_marquardt(arm, pose_at(path, s), task, bounds, q);
    if (found.converged) q = found.q;
  }
  path_parameters.push_back(exact.path_parameters.back());
  return path_parameters;
}

/// Adds segment i of a branch to the section.
void add(Section& section, const TrackedSegment& segment, std::size_t i) {
  for (std::size_t k = 1; k < segment.samples.size(); ++k) {
    section.samples.push_back(segment.samples[k]);
    section.path_parameters.push_back(static_cast<double>(i) + segment.fractions[k]);
  }
  // A segment at rest has no sample of its own.
  section.path_parameters.back() = static_cast<double>(i + 1);
}

/// Appends the retimed section, or sets the status and reason of `timed`.
void append(TimedPlan& timed, const Arm& arm, const ToolPath& path, const Section& section,
            const Task& task, const RetimeOptions& options) {
  const std::size_t before = timed.trajectory.size();
  std::vector<double> path_parameters = section.path_parameters;
  const auto move = [&](Trajectory& motion, std::span<const double> arc_lengths) {
    path_parameters = move_onto_path(arm, path, task, section, arc_lengths, motion);
  };
  timed.reason = append_retimed(arm, timed.trajectory, section.samples, options, move);
  if (!timed.reason.empty()) {
    timed.status = MotionStatus::outside_limits;
    return;
  }
  const std::size_t added = timed.trajectory.size() - before;
  if (added > 0 && added + 1 != path_parameters.size()) {
    timed.status = MotionStatus::not_found;
    timed.reason =
        "the joints are at rest on a part of the path without a stop, so there is no smooth time "
        "scaling; put a stop there";
    return;
  }
  if (added > 0) {
    timed.path_parameters.insert(timed.path_parameters.end(), path_parameters.begin() + 1,
                                 path_parameters.end());
  }
  timed.path_parameters.back() = path_parameters.back();
}

}  // namespace

TimedPlan time_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                    const RetimeOptions& options) {
  TimedPlan timed{.trajectory = at_rest(arm, plan.start), .path_parameters = {0}};
  Section section{{plan.start}, {0}};
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    add(section, plan.segments[i], i);
    if (i + 1 < plan.segments.size() && !route.stops[i]) continue;
    append(timed, arm, route.path, section, task, options);
    if (timed.status != MotionStatus::reached) {
      timed.reason = "up to the end of segment " + std::to_string(i + 1) + ": " + timed.reason;
      return timed;
    }
    section = {{section.samples.back()}, {section.path_parameters.back()}};
  }
  return timed;
}

}  // namespace beeline::internal
