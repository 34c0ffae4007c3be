#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/kinematics/forward.h>
#include <beeline/math/minimise.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_passages.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr double far_away = std::numeric_limits<double>::infinity();

}  // namespace

double blend_distance(const Move& move, const Deviation& away) {
  const Deviation most = blend_deviation(move);
  return std::max(away.position / most.position, away.orientation / most.orientation);
}

double allowed_in_blend(const Arm& arm, const Move& move, int i) {
  const bool slides = kind(arm.joint_of(i)) == JointKind::prismatic;
  return slides ? blend_deviation(move).position : blend_deviation(move).orientation;
}

double blend_distance(const Arm& arm, const Task& task, const Move& move, const Pose& waypoint,
                      const Configuration& q, const Pose& tool) {
  double largest = blend_distance(move, task_deviation(task, waypoint, tool));
  for (int i = 0; move.q && i < arm.dof(); ++i) {
    largest = std::max(largest, std::abs(q[i] - (*move.q)[i]) / allowed_in_blend(arm, move, i));
  }
  return largest;
}

std::size_t Passage::before() const { return static_cast<std::size_t>(std::floor(at)); }
std::size_t Passage::after() const { return static_cast<std::size_t>(std::ceil(at)); }
std::size_t Passage::nearest() const { return static_cast<std::size_t>(std::floor(at + 0.5)); }

WaypointPassages::WaypointPassages(const Arm& arm, const Trajectory& trajectory, const Task& task,
                                   const std::vector<Pose>& tool, BudgetMeter& budget)
    : arm_(arm),
      trajectory_(trajectory),
      task_(task),
      tool_(tool),
      budget_(budget),
      boxes_(tool, task) {}

double WaypointPassages::distance(const Move& move, std::size_t k) const {
  return blend_distance(arm_, task_, move, waypoint_of(arm_, move), trajectory_.positions[k],
                        tool_[k]);
}

bool WaypointPassages::is_near(const Pose& waypoint, const Deviation& blend, std::size_t k) const {
  return within(task_deviation(task_, waypoint, tool_[k]), blend);
}

std::size_t WaypointPassages::next_near(const Pose& waypoint, const Deviation& blend,
                                        std::size_t first) const {
  constexpr std::size_t batch = 64;  // samples
  const auto next = [&](std::size_t k) {
    return boxes_.next_near(waypoint.translation(), blend.position, k);
  };
  std::size_t k = next(first);
  for (std::size_t looks = 1; k < tool_.size() && !is_near(waypoint, blend, k); ++looks) {
    if (looks % batch == 0 && budget_.ended()) return tool_.size();
    k = next(k + 1);
  }
  return k;
}

double WaypointPassages::distance_at(const Move& move, const Pose& waypoint, double at) const {
  const auto k = static_cast<std::size_t>(at);
  if (at == static_cast<double>(k)) {  // the last sample, too, has no interval after it
    return blend_distance(arm_, task_, move, waypoint, trajectory_.positions[k], tool_[k]);
  }
  Configuration q(arm_.dof());
  for (int i = 0; i < arm_.dof(); ++i) {
    q[i] = interval_polynomial(trajectory_, k, i)(at - static_cast<double>(k));
  }
  return blend_distance(arm_, task_, move, waypoint, q, forward_kinematics(arm_, q));
}

/// Whether all joints may be within their deviations from the waypoint of a move, if this is a
/// configuration, between sample k and the next.
bool WaypointPassages::joints_may_be_within(const Move& move, std::size_t k) const {
  for (int i = 0; move.q && i < arm_.dof(); ++i) {
    const Extremes between = enclosure(interval_polynomial(trajectory_, k, i));
    const double allowed = allowed_in_blend(arm_, move, i), goal = (*move.q)[i];
    if (between.smallest > goal + allowed || between.largest < goal - allowed) return false;
  }
  return true;
}

/// Whether the motion between the neighbours of sample k may be within the deviation of a blend of
/// its waypoint, from which the sample has a distance. It only proposes: the tool is taken to be
/// hardly farther from the sample than at its neighbours, so a passage may be missed.
bool WaypointPassages::may_be_within(const Move& move, std::size_t k, double distance) const {
  constexpr double hardly = 1.5;
  if (distance <= 1) return true;
  const auto tool_step = [&](std::size_t other) {
    return blend_distance(move, task_deviation(task_, tool_[k], tool_[other]));
  };
  const auto may = [&](std::size_t interval, std::size_t other) {
    const bool far = !move.q && distance > 1 + hardly * tool_step(other);
    return !far && joints_may_be_within(move, interval);
  };
  return (k > 0 && may(k - 1, k - 1)) || (k + 1 < trajectory_.size() && may(k, k + 1));
}

/// The local minimum between the neighbours of sample k, not before `first`, and its distance.
Passage WaypointPassages::refined(const Move& move, const Pose& waypoint, std::size_t k,
                                  double first, double& distance) const {
  constexpr int sections = 24;   // to 1e-5 of an interval
  constexpr double gain = 1e-9;  // smaller ones are rounding: the minimum is the sample
  const auto sample = static_cast<double>(k);
  Passage best{std::max(sample, first)};
  distance = distance_at(move, waypoint, best.at);
  const auto try_between = [&](double begin, double end) {
    if (!(begin < end)) return;
    const Minimum found = golden_section(
        begin, end, sections, [&](double at) { return distance_at(move, waypoint, at); });
    if (!(found.value < distance * (1 - gain))) return;
    distance = found.value;
    best.at = found.x;
  };
  try_between(std::max(sample - 1, first), sample);
  try_between(best.at > sample ? best.at : sample,
              std::min(sample + 1, static_cast<double>(trajectory_.size() - 1)));
  return best;
}

std::optional<NearestSample> WaypointPassages::nearest(const Move& move, std::size_t first) const {
  const std::vector<Passage> passed = passages(move, static_cast<double>(first), 1);
  if (passed.empty()) return std::nullopt;
  // Where the tool comes near the waypoint it may be at rest, or come nearer a second time.
  NearestSample nearest{passed.front().nearest()};
  double least = distance(move, nearest.sample);
  for (std::size_t k = nearest.sample + 1; k < trajectory_.size() && !budget_.ended(); ++k) {
    const double here = distance(move, k);
    if (!(here <= 1)) break;
    if (here < least) nearest.sample = k, least = here;
  }
  refined(move, waypoint_of(arm_, move), nearest.sample, static_cast<double>(first),
          nearest.distance);
  return nearest;
}

std::vector<Passage> WaypointPassages::passages(const Move& move, double first,
                                                std::size_t most) const {
  std::vector<Passage> found;
  const Pose waypoint = waypoint_of(arm_, move);
  const std::size_t count = trajectory_.size();
  const auto next_near = [&](std::size_t k) {
    return boxes_.next_near(waypoint.translation(), move.blend, k);
  };
  const auto distance_of = [&](std::size_t k) {
    return blend_distance(arm_, task_, move, waypoint, trajectory_.positions[k], tool_[k]);
  };
  constexpr int work = 50;  // configurations of a local minimum
  double before = far_away, next_distance = far_away;
  std::size_t k = next_near(static_cast<std::size_t>(first));
  while (k < count && found.size() < most && !budget_.ended()) {
    const double here = next_distance < far_away ? next_distance : distance_of(k);
    const std::size_t next = next_near(k + 1);
    next_distance = next == k + 1 && next < count ? distance_of(next) : far_away;
    if (here < before && here <= next_distance && may_be_within(move, k, here)) {
      if (budget_.ended(work)) break;
      double least = here;
      Passage passage{static_cast<double>(k)};
      // Between two samples only where the sample is not a passage itself: a line may begin at it.
      if (passage.at < first || here > 1) passage = refined(move, waypoint, k, first, least);
      if (least <= 1 && (found.empty() || passage.at > found.back().at)) found.push_back(passage);
    }
    before = next == k + 1 ? here : far_away;
    k = next;
  }
  return found;
}

}  // namespace beeline::internal
