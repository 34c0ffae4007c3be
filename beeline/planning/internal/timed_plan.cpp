#include <algorithm>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_parameter.h>
#include <beeline/path/joint_spline.h>
#include <beeline/planning/internal/timed_plan.h>
#include <beeline/planning/internal/timed_samples.h>

namespace beeline {
namespace {

/// What the arm does from one stop to the next.
struct Stretch {
  std::vector<Configuration> samples;
  std::vector<double> path_parameters;
};

/// The samples at equal times are on the spline through the stretch's exact ones, so far on the way
/// along these: each but the first and the last is brought onto the path. Returns their path
/// parameters.
std::vector<double> put_on_path(const Arm& arm, const ToolPath& path, const Task& task,
                                const Stretch& exact, std::span<const double> ways,
                                Trajectory& timed) {
  const internal::Bounds bounds = internal::bounds_of(arm);
  const std::vector<double> passed = chord_length(exact.samples);
  std::vector<double> path_parameters{exact.path_parameters.front()};
  for (std::size_t k = 1; k + 1 < timed.size(); ++k) {
    const auto next = std::upper_bound(passed.begin() + 1, passed.end() - 1, ways[k]);
    const auto i = static_cast<std::size_t>(next - passed.begin());
    const double from = std::max(exact.path_parameters[i - 1], path_parameters.back()),
                 to = exact.path_parameters[i];
    Configuration& q = timed.positions[k];
    path_parameters.push_back(nearest_parameter(path, task, forward_kinematics(arm, q), from, to));
    const internal::NumericalResult found =
        internal::levenberg_marquardt(arm, pose_at(path, path_parameters.back()), task, bounds, q);
    if (found.converged) q = found.q;
  }
  path_parameters.push_back(exact.path_parameters.back());
  return path_parameters;
}

void add(Stretch& stretch, const TrackedSegment& segment, double before) {
  for (std::size_t k = 1; k < segment.samples.size(); ++k) {
    stretch.samples.push_back(segment.samples[k]);
    stretch.path_parameters.push_back(before + segment.fractions[k]);
  }
  stretch.path_parameters.back() = before + 1;  // also where what matters stands still
}

/// Appends the stretch with its times, or says why it has none.
void append(TimedPlan& timed, const Arm& arm, const ToolPath& path, const Stretch& stretch,
            const Task& task, const RetimeOptions& options) {
  const std::size_t before = timed.trajectory.size();
  std::vector<double> path_parameters = stretch.path_parameters;
  const auto brought = [&](Trajectory& motion, std::span<const double> ways) {
    path_parameters = put_on_path(arm, path, task, stretch, ways, motion);
  };
  timed.reason = append_timed(timed.trajectory, arm, stretch.samples, options, brought);
  if (!timed.reason.empty()) {
    timed.status = MotionStatus::outside_limits;
    return;
  }
  const std::size_t added = timed.trajectory.size() - before;
  if (added > 0 && added + 1 != path_parameters.size()) {
    timed.status = MotionStatus::not_converged;
    timed.reason = "the joints stand still on a part of the way, which has no smooth time scaling";
    return;
  }
  if (added > 0)
    timed.path_parameters.insert(timed.path_parameters.end(), path_parameters.begin() + 1,
                                 path_parameters.end());
  timed.path_parameters.back() = path_parameters.back();
}

}  // namespace

TimedPlan timed_plan(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                     const RetimeOptions& options) {
  TimedPlan timed{.trajectory = at_rest(arm, plan.start), .path_parameters = {0}};
  Stretch stretch{{plan.start}, {0}};
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    add(stretch, plan.segments[i], static_cast<double>(i));
    if (i + 1 < plan.segments.size() && !route.stops[i]) continue;
    append(timed, arm, route.path, stretch, task, options);
    if (timed.status != MotionStatus::reached) {
      timed.reason = "up to the end of segment " + std::to_string(i + 1) + ": " + timed.reason;
      return timed;
    }
    stretch = {{stretch.samples.back()}, {stretch.path_parameters.back()}};
  }
  return timed;
}

}  // namespace beeline
