#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/tool_boxes.h>
#include <beeline/planning/internal/waypoint_rests.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>

namespace beeline::internal {

namespace {

constexpr double rest_distance = 1e-5;  // radians or metres from the arrival's configuration
constexpr double at_waypoint = 1e-3;    // of the tolerance

/// The values of the first three joints; 0 for those that the arm does not have.
Vector3 first_joints(const Configuration& q) {
  Vector3 first = Vector3::Zero();
  const Eigen::Index count = std::min<Eigen::Index>(3, q.size());
  first.head(count) = q.head(count);
  return first;
}

}  // namespace

WaypointRests::WaypointRests(const Arm& arm, const Trajectory& trajectory, const Task& task,
                             const Deviation& tolerance)
    : arm_(arm),
      trajectory_(trajectory),
      task_(task),
      tolerance_(tolerance),
      limits_(motion_limits_of(arm)) {
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    tool_.push_back(forward_kinematics(arm, trajectory.positions[k]));
    rests_.push_back(is_slow(k));
  }
  all_ = all_rests();
  std::vector<BoxBlocks::Box> tool, joints;
  for (const Rest& rest : all_) {
    tool.emplace_back();
    joints.emplace_back();
    for (std::size_t k = rest.first; k <= rest.last; ++k) {
      tool.back().extend(constrained(task_, tool_[k].translation()));
      joints.back().extend(first_joints(trajectory.positions[k]));
    }
  }
  tool_boxes_.emplace(std::move(tool));
  joint_boxes_.emplace(std::move(joints));
}

std::vector<WaypointRests::Rest> WaypointRests::all_rests() const {
  std::vector<Rest> all;
  for (std::size_t k = 0; k < rests_.size(); ++k) {
    if (!rests_[k]) continue;
    const bool continues = !all.empty() && all.back().last + 1 == k && rests_between(k - 1);
    if (continues) {
      all.back().last = k;
    } else {
      all.push_back({k, k});
    }
  }
  return all;
}

/// The first rest from `first` on that may be within tolerance of a move's waypoint.
std::size_t WaypointRests::next_rest(const Move& move, std::size_t first) const {
  const auto with_rounding = [](double most, const Vector3& goal) {
    return (1 + 1e-9) * most + 1e-12 * goal.norm();
  };
  if (!move.q) {
    const Vector3 goal = constrained(task_, move.target.translation());
    return tool_boxes_->next_near(goal, with_rounding(tolerance_.position, goal), first);
  }
  const Vector3 goal = first_joints(*move.q);
  const double most = std::sqrt(3.0) * std::max(tolerance_.position, tolerance_.orientation);
  return joint_boxes_->next_near(goal, with_rounding(most, goal), first);
}

double WaypointRests::offset(const Pose& goal, const Pose& tool) const {
  const Deviation away = task_deviation(task_, goal, tool);
  return std::max(away.position / tolerance_.position, away.orientation / tolerance_.orientation);
}

double WaypointRests::offset(const Move& move, std::size_t k) const {
  if (!move.q) return offset(move.target, k);
  double largest = 0;
  for (int i = 0; i < arm_.dof(); ++i) {
    const bool slides = kind(arm_.joint_of(i)) == JointKind::prismatic;
    const double tolerance = slides ? tolerance_.position : tolerance_.orientation;
    largest = std::max(largest, std::abs(trajectory_.positions[k][i] - (*move.q)[i]) / tolerance);
  }
  return largest;
}

bool WaypointRests::is_slow(std::size_t k) const {
  if (k == 0 || k + 1 == trajectory_.size()) return true;
  const auto slow = [&](const Configuration& velocity, double h) {
    return counts_as_rest(trajectory_, limits_, velocity, h);
  };
  if (!trajectory_.velocities.empty()) return slow(trajectory_.velocities[k], 0);
  const auto slow_after = [&](std::size_t first) {
    const double h = trajectory_.times[first + 1] - trajectory_.times[first];
    return slow((trajectory_.positions[first + 1] - trajectory_.positions[first]) / h, h);
  };
  return slow_after(k - 1) && slow_after(k);
}

bool WaypointRests::rests_after(std::size_t k, const Move& move, std::size_t at) const {
  if (offset(move, k) > 1 || offset(move, k + 1) > 1) return false;
  const double h = trajectory_.times[k + 1] - trajectory_.times[k];
  for (int i = 0; i < arm_.dof(); ++i) {
    const Polynomial p = interval_polynomial(trajectory_, k, i);
    const Extremes q = enclosure(p), v = enclosure(time_derivative(p, 1, h));
    const double goal = trajectory_.positions[at][i];
    const double largest = rest_velocity(trajectory_, limits_[static_cast<std::size_t>(i)], h);
    const bool near = q.smallest >= goal - rest_distance && q.largest <= goal + rest_distance;
    if (!near || !(v.smallest >= -largest && v.largest <= largest)) return false;
  }
  return true;
}

/// Whether the joints rest from sample k to the next.
bool WaypointRests::rests_between(std::size_t k) const {
  const double h = trajectory_.times[k + 1] - trajectory_.times[k];
  for (int i = 0; i < arm_.dof(); ++i) {
    const Extremes q = enclosure(interval_polynomial(trajectory_, k, i));
    const double largest = rest_velocity(trajectory_, limits_[static_cast<std::size_t>(i)], h);
    if (!(q.largest - q.smallest <= std::max(rest_distance, largest * h))) return false;
  }
  return true;
}

std::vector<std::size_t> WaypointRests::rests(const Move& move, std::size_t first) const {
  std::vector<std::size_t> exact, others;
  const auto from =
      std::lower_bound(all_.begin(), all_.end(), first,
                       [](const Rest& rest, std::size_t sample) { return rest.last < sample; });
  std::size_t next = next_rest(move, static_cast<std::size_t>(from - all_.begin()));
  for (; next < all_.size(); next = next_rest(move, next + 1)) {
    const Rest& rest = all_[next];
    std::size_t nearest = std::max(rest.first, first);
    double least = offset(move, nearest);
    for (std::size_t k = nearest + 1; k <= rest.last && least > at_waypoint; ++k) {
      // Several samples are at the waypoint. The first one is taken, because rounding errors decide
      // which is nearest.
      const double here = offset(move, k);
      if (here < least) nearest = k, least = here;
    }
    if (least <= 1) (least <= at_waypoint ? exact : others).push_back(nearest);
  }
  exact.insert(exact.end(), others.begin(), others.end());
  return exact;
}

std::optional<std::size_t> WaypointRests::passes(const Move& move, std::size_t first) const {
  while (first < tool_.size() && !(offset(move, first) <= 1)) ++first;
  if (first == tool_.size()) return {};
  std::size_t nearest = first;
  double least = offset(move, first);
  for (std::size_t k = first + 1; k < tool_.size(); ++k) {
    const double here = offset(move, k);
    if (!(here <= 1)) break;
    if (here < least) nearest = k, least = here;
  }
  return nearest;
}

}  // namespace beeline::internal
