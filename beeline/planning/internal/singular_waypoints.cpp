#include <algorithm>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/internal/singular_waypoints.h>
#include <beeline/planning/internal/track_path.h>
#include <beeline/planning/internal/track_segment.h>

namespace beeline::internal {
namespace {

constexpr int max_continuations = 64;  // of one branch

/// Reverses the samples of a segment that was tracked backwards.
void reverse(TrackedSegment& tracked) {
  std::reverse(tracked.samples.begin(), tracked.samples.end());
  std::reverse(tracked.fractions.begin(), tracked.fractions.end());
  for (double& fraction : tracked.fractions) fraction = 1 - fraction;
}

/// Completes a segment that was nearly tracked to its end. Where the segment is tangent to the
/// singular poses at its end, samples are determined to the square root of rounding near there, and
/// steps between them are not proved; a configuration at the end is near them all the same.
bool complete_near_end(const Arm& arm, const Segment& segment, const Task& task,
                       const Bounds& bounds, TrackedSegment& tracked) {
  constexpr double near_end = 0.1;  // of the segment
  constexpr double near = 0.2;      // radians or metres
  if (1 - tracked.fractions.back() > near_end) return false;
  const NumericalResult end =
      levenberg_marquardt(arm, pose_at(segment, 1), task, bounds, tracked.samples.back());
  const Configuration step = end.q - tracked.samples.back();
  if (!end.converged || step.lpNorm<Eigen::Infinity>() > near) return false;
  tracked.samples.push_back(end.q);
  tracked.fractions.push_back(1);
  return true;
}

/// Interpolates the samples linearly; empty after the last.
Configuration configuration_at(const TrackedSegment& tracked, double s) {
  const std::vector<double>& fractions = tracked.fractions;
  const auto next = std::lower_bound(fractions.begin(), fractions.end(), s);
  if (next == fractions.end()) return {};
  const auto k = static_cast<std::size_t>(next - fractions.begin());
  if (k == 0) return tracked.samples.front();
  const double t = (s - fractions[k - 1]) / (fractions[k] - fractions[k - 1]);
  return (1 - t) * tracked.samples[k - 1] + t * tracked.samples[k];
}

std::function<Configuration(double)> guide_along(const TrackedSegment& departure) {
  return [&departure](double s) { return configuration_at(departure, s); };
}

/// Adds the multiples of 2 pi for which the samples begin nearest to q.
void begin_near(const Arm& arm, const Configuration& q, TrackedSegment& tracked) {
  const Configuration first = tracked.samples.front();
  const Configuration shift = nearest_representative(arm, first, q, no_bounds(arm)) - first;
  for (Configuration& sample : tracked.samples) sample += shift;
}

}  // namespace

bool is_near_singular(const Arm& arm, const Task& task, const Configuration& q) {
  // A configuration is solved to the square root of rounding at the boundary of the workspace.
  constexpr double near = 1e-3;
  const Eigen::MatrixXd j = task_jacobian(arm, q, task, unit_of_length(arm));
  return 1 / manipulability_measures(j).condition < near;
}

Bounds bounds_without_turns(const Arm& arm) {
  Bounds bounds = bounds_of(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    if (!arm.periodic(k)) continue;
    bounds.lower[k] = -Limits::none;
    bounds.upper[k] = Limits::none;
  }
  return bounds;
}

/// The branches from the beginning of a segment to a pose inside it.
const std::vector<TrackedSegment>& SingularWaypoints::departures(std::size_t segment) {
  const auto known = departures_.find(segment);
  if (known != departures_.end()) return known->second;
  std::vector<TrackedSegment>& found = departures_[segment];
  const Segment& forward = search_.path.segments[segment];
  InverseResult inside;
  double s = 0;
  for (const double fraction : {0.5, 0.3, 0.7, 0.1}) {
    s = fraction;
    inside = inverse_kinematics(search_.arm, pose_at(forward, s),
                                {.task = search_.options.task,
                                 .all = true,
                                 .ignore_limits = true,
                                 .budget = search_.budget.part()});
    if (!inside.solutions.empty() && !inside.singular) break;
  }
  const Segment backward = reversed(forward);
  const Bounds bounds = bounds_without_turns(search_.arm);
  for (const Configuration& q : inside.solutions) {
    if (search_.budget.ended()) break;
    if (!within(bounds, q)) continue;
    TrackedSegment tracked = track_segment(search_.arm, backward, search_.options.task, bounds, q,
                                           {.tolerance = search_.options.tolerance,
                                            .max_samples = search_.options.max_samples,
                                            .begin = 1 - s,
                                            .budget = search_.budget});
    if (!tracked.complete() &&
        !complete_near_end(search_.arm, backward, search_.options.task, bounds, tracked)) {
      continue;
    }
    reverse(tracked);
    found.push_back(std::move(tracked));
  }
  return found;
}

/// Returns the departures that begin at q, which is known to the accuracy of a configuration at a
/// singularity.
std::vector<TrackedSegment> SingularWaypoints::departures_from(std::size_t segment,
                                                               const Configuration& q) {
  constexpr double same = 1e-3;  // radians or metres
  std::vector<TrackedSegment> found;
  for (const TrackedSegment& departure : departures(segment)) {
    if (!same_posture(search_.arm, departure.samples.front(), q, same)) continue;
    found.push_back(departure);
    begin_near(search_.arm, q, found.back());
  }
  return found;
}

/// The next departure of the last waypoint that has one left; null if none has. The last of the
/// choices is then that waypoint.
const TrackedSegment* SingularWaypoints::next_departure(const Branch& branch, std::size_t first,
                                                        std::vector<Choice>& choices) {
  for (std::size_t i = branch.segments.size(); i > first; --i) {
    const std::size_t segment = i - 1;
    if (choices.empty() || choices.back().segment != segment) {
      if (stands_still(search_.path.segments[segment], search_.options.task)) continue;
      const Configuration& q = branch.segments[segment].samples.front();
      if (!is_near_singular(search_.arm, search_.options.task, q)) continue;
      choices.push_back({segment, departures_from(segment, q)});
    }
    Choice& last = choices.back();
    if (last.next < last.departures.size()) return &last.departures[last.next++];
    choices.pop_back();
  }
  return nullptr;
}

bool SingularWaypoints::complete(Branch& branch, std::size_t first, const Accept& accept) {
  std::vector<Choice> choices;
  Branch current = branch;
  for (int i = 0; !search_.budget.ended(); ++i) {
    if (current.path_parameter > branch.path_parameter) branch = current;
    if (current && accept(current)) {
      branch = std::move(current);
      return true;
    }
    if (i == max_continuations) break;
    const TrackedSegment* departure = next_departure(current, first, choices);
    if (departure == nullptr) break;
    current.segments.resize(choices.back().segment);
    current.status = MotionStatus::reached;
    track_path(search_, current, guide_along(*departure));
  }
  return false;
}

std::vector<Branch> SingularWaypoints::branches_from_beginning() {
  std::vector<Branch> branches;
  std::size_t first = 0;
  while (first + 1 < search_.path.segments.size() &&
         stands_still(search_.path.segments[first], search_.options.task)) {
    ++first;
  }
  if (stands_still(search_.path.segments[first], search_.options.task)) return branches;
  for (const TrackedSegment& departure : departures(first)) {
    if (search_.budget.ended()) break;
    Branch branch{.start = departure.samples.front()};
    track_path(search_, branch, guide_along(departure));
    branches.push_back(std::move(branch));
  }
  return branches;
}

}  // namespace beeline::internal
