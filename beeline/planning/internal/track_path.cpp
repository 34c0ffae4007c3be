#include <algorithm>
#include <utility>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/track_path.h>
#include <beeline/planning/internal/track_segment.h>

namespace beeline::internal {
namespace {

/// Whether the arm rests at q along a segment: the task's rows stand still, and the tool is at its
/// end. After several such segments it may be farther away than the next one accepts.
bool rests_along(const BranchSearch& search, const Segment& segment, const Configuration& q) {
  const Task& task = search.options.task;
  const double near = start_tolerance(search.arm);
  return stands_still(segment, task) &&
         within(task_deviation(task, pose_at(segment, 1), forward_kinematics(search.arm, q)),
                {near, near});
}

}  // namespace

void set_segment(const ToolPath& path, std::size_t i, Reason& reason) {
  reason.set(ReasonField::segment, i + 1);
  reason.set(ReasonField::segment_name,
             path.names.empty() ? (all_lines(path) ? "line " : "segment ") + std::to_string(i + 1) +
                                      " of " + std::to_string(path.segments.size())
                                : segment_name(path, i));
}

void set_ended(const ToolPath& path, Ending ending, Branch& branch) {
  set_ended(ReasonCode::ended_on_path, ending, branch);
  if (!(branch.path_parameter > 0)) return;
  const auto i = static_cast<std::size_t>(branch.path_parameter);
  const bool whole = i == path.segments.size();
  if (!whole) set_segment(path, i, branch.reason);
  branch.reason.set(ReasonField::fraction,
                    whole ? 1 : branch.path_parameter - static_cast<double>(i));
}

void track_path(const BranchSearch& search, Branch& branch,
                std::function<Configuration(double)> departure) {
  const ToolPath& path = search.path;
  const BranchOptions& options = search.options;
  BudgetMeter& budget = search.budget;
  Configuration q = branch.start;
  std::size_t samples_left = options.max_samples;
  // The sample at the joint of two segments belongs to both.
  for (const TrackedSegment& tracked : branch.segments) {
    q = tracked.samples.back();
    samples_left -= std::min(samples_left, tracked.samples.size() - 1);
  }
  const auto segments = static_cast<double>(path.segments.size());
  for (std::size_t i = branch.segments.size(); i < path.segments.size(); ++i) {
    const auto begin = static_cast<double>(i);
    if (rests_along(search, path.segments[i], q)) {
      branch.segments.push_back({{q}, {1}, {}});
      branch.path_parameter = begin + 1;
      continue;
    }
    TrackOptions track_options{
        .tolerance = options.tolerance, .max_samples = samples_left, .budget = budget};
    if (departure) {
      track_options.guide = std::exchange(departure, {});
    } else if (options.guide) {
      track_options.guide = [&](double s) { return options.guide(begin + s); };
    }
    if (budget.reports()) {
      track_options.progress = [&](double s) { budget.report((begin + s) / segments); };
    }
    branch.segments.push_back(
        track_segment(search.arm, path.segments[i], options.task, search.bounds, q, track_options));
    const TrackedSegment& tracked = branch.segments.back();
    branch.path_parameter = begin + tracked.fractions.back();
    q = tracked.samples.back();
    if (!tracked.complete()) {
      branch.status = MotionStatus::not_found;
      if (!budget.complete()) set_ended(path, budget.ending(), branch);
      return;
    }
    samples_left -= std::min(samples_left, tracked.samples.size() - 1);
    budget.report((begin + 1) / segments);
  }
}

}  // namespace beeline::internal
