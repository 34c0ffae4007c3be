#include <algorithm>

#include <beeline/certificate/internal/sample_locator.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/consistent_parameters.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {

/// The samples up to a stop: their path parameters, and the deviation of each from the stop as a
/// fraction of the tolerance, or -1 if the sample is not at the stop.
struct SampleLocator::Located {
  std::vector<double> path_parameters, from_end;
  bool reached = false;  ///< whether some sample is at the stop
  bool off = false;      ///< whether the last sample is off the path

  /// Keeps the samples up to the one nearest to the end. That sample is chosen among the first
  /// consecutive samples at the end, or among the last ones at the end of the route.
  void cut_at_arrival(bool last) {
    std::size_t k = 0;
    if (last && from_end.back() >= 0) {
      for (k = from_end.size() - 1; k > 0 && from_end[k - 1] >= 0;) --k;
    }
    while (from_end[k] < 0) ++k;
    std::size_t nearest = k;
    for (; k < from_end.size() && from_end[k] >= 0; ++k) {
      if (from_end[k] < from_end[nearest]) nearest = k;
    }
    path_parameters.resize(nearest + 1);
  }
};

namespace {

bool is_line(const ToolPath& path, std::size_t first, std::size_t last) {
  return first == last && std::holds_alternative<Line>(path.segments[last]);
}

}  // namespace

/// Returns a lower bound of the path parameters after which the path stays within tolerance of the
/// end of a segment, to the resolution of a sixty-fourth of a segment.
double SampleLocator::closing_parameter(std::size_t begin, std::size_t segment) const {
  constexpr int divisions = 64;
  const Pose goal = pose_at(route_.path.segments[segment], 1);
  for (std::size_t i = segment + 1; i-- > begin;) {
    for (int j = divisions - 1; j >= 0; --j) {
      const double s = static_cast<double>(j) / divisions;
      if (!near(task_deviation(task_, goal, pose_at(route_.path.segments[i], s)))) {
        return static_cast<double>(i) + s;
      }
    }
  }
  return -1;
}

/// Finds the path parameters of the samples from `first` on, from `begin` to the end of
/// `segment`. Stops at a sample that is off the path, and at one that leaves the segment's end
/// again. The route's end is an exception: the tool may pass near it before.
SampleLocator::Located SampleLocator::locate(std::size_t first, const PathTracker& tracker,
                                             std::size_t begin, std::size_t segment) const {
  const bool last = segment + 1 == route_.path.segments.size();
  const Pose goal = pose_at(route_.path.segments[segment], 1);
  const bool line = is_line(route_.path, begin, segment);
  // The beginning of a closed path is near its end too.
  const double closing = line ? 0 : closing_parameter(begin, segment);
  Located found;
  for (std::size_t k = first; k < trajectory_.size(); ++k) {
    if (!last && found.reached && found.from_end.back() < 0) break;
    if (budget_.ended()) break;
    const Pose& tool = world_T_tool_[k];
    const double from =
        found.path_parameters.empty() ? static_cast<double>(begin) : found.path_parameters.back();
    const std::optional<double> fit =
        line ? tracker.nearest(tool, from) : tracker.first_within(tool, from);
    const double s = fit.value_or(from);
    found.path_parameters.push_back(s);
    const Deviation left = task_deviation(task_, goal, tool);
    // s is the first parameter within the tolerance, not the nearest.
    const bool at_end = near(left) && (line || tracker.first_fit(tool, s).value_or(s) > closing);
    found.from_end.push_back(at_end ? std::max(left.position / tolerance_.position,
                                               left.orientation / tolerance_.orientation)
                                    : -1);
    found.reached = found.reached || at_end;
    if (fit) continue;
    found.path_parameters.back() = tracker.nearest(tool, from);
    found.off = true;
    break;
  }
  return found;
}

/// Replaces the first path parameters within the tolerance by the parameters that fit best
/// together.
void SampleLocator::make_consistent(const PathTracker& tracker, std::size_t first,
                                    Located& found) const {
  std::vector<double>& s = found.path_parameters;
  const auto poses = std::span(world_T_tool_).subspan(first);
  const double off = s.back();
  if (found.off && !found.reached) s.pop_back();
  if (!found.reached && s.size() > 1) {
    const std::size_t last = s.size() - 1;
    s[last] = tracker.first_fit(poses[last], s[last]).value_or(s[last]);
  }
  if (s.size() > 1) {
    s = consistent_parameters(
        tracker, poses, s, [&](std::size_t k) { return moved(tracker, first + k); }, budget_);
  }
  if (found.off && !found.reached) s.push_back(std::max(off, s.back()));
}

/// Returns the length of the tool's motion from sample k to the next.
double SampleLocator::moved(const PathTracker& tracker, std::size_t k) const {
  constexpr int chords = 8;
  double length = 0;
  Pose before = world_T_tool_[k];
  for (int j = 1; j <= chords; ++j) {
    Configuration q = trajectory_.positions[k + 1];
    for (int i = 0; i < arm_.dof() && j < chords; ++i) {
      q[i] = interval_polynomial(trajectory_, k, i)(static_cast<double>(j) / chords);
    }
    const Pose here = forward_kinematics(arm_, q);
    length += tracker.distance(before, here);
    before = here;
  }
  return length;
}

SampleParameters SampleLocator::from(std::size_t first, std::size_t begin, std::size_t last) const {
  const auto end = static_cast<double>(last + 1);
  const PathTracker tracker(route_.path, task_, static_cast<double>(begin), end, tolerance_,
                            budget_);
  if (!budget_.complete()) return {};
  Located found = locate(first, tracker, begin, last);
  if (!budget_.complete()) return {};
  if (found.reached) {
    found.cut_at_arrival(last + 1 == route_.path.segments.size());
    found.path_parameters.back() = end;
  }
  if (!is_line(route_.path, begin, last)) make_consistent(tracker, first, found);
  return {std::move(found.path_parameters), found.reached};
}

}  // namespace beeline::internal
