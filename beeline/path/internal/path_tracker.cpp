#include <algorithm>
#include <cmath>

#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/minimise.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/path_tracker.h>

namespace beeline::internal {
namespace {

constexpr double stride = 1.0 / 32;      // of a segment, the longest cell
constexpr double farthest_fit = 2;       // segments that the tool may pass between two samples
constexpr double short_cell = 0.05;      // of the tolerance
constexpr double straight_cosine = 0.8;  // of the angle between tangents a quarter of a cell apart
constexpr int max_halvings = 24;
constexpr std::size_t max_fits = 8;

/// The components that the task constrains, rotations in metres.
Twist weighted_rows(const Task& task, Twist twist) {
  twist = masked(task, twist);
  twist.tail<3>() *= metres_per_radian;
  return twist;
}

double weighted(const Deviation& deviation) {
  return std::hypot(deviation.position, metres_per_radian * deviation.orientation);
}

}  // namespace

PathTracker::PathTracker(const ToolPath& path, const Task& task, double from, double to,
                         const Deviation& tolerance, BudgetMeter& budget)
    : path_(path), task_(task), to_(to), tolerance_(tolerance), nodes_{from} {
  for (double a = from; a < to;) {
    if (budget.ended()) return;
    const double next = (std::floor(a / stride + 1e-9) + 1) * stride;
    const double b = to - next < 1e-9 ? to : next;
    divide(a, b, 0);
    a = b;
  }
  lengths_ = {0};
  for (std::size_t k = 1; k < nodes_.size(); ++k) {
    if (budget.ended()) return;
    lengths_.push_back(lengths_.back() +
                       distance(pose_at(path, nodes_[k - 1]), pose_at(path, nodes_[k])));
  }
}

/// Appends the ends of the cells in [a, b].
void PathTracker::divide(double a, double b, int depth) {
  const std::size_t i = std::min(static_cast<std::size_t>(a), path_.segments.size() - 1);
  const auto tangent = [&](double s) {
    const double local = std::clamp(s - static_cast<double>(i), 0.0, 1.0);
    return weighted_rows(task_, motion_at(path_.segments[i], local).velocity);
  };
  Twist before = tangent(a);
  double length = before.norm();
  bool straight = true;
  for (int k = 1; k <= 4; ++k) {
    const Twist here = tangent(a + (b - a) * k / 4);
    const double norm = here.norm();
    straight = straight && here.dot(before) >= straight_cosine * norm * before.norm();
    length = std::max(length, norm);
    before = here;
  }
  const double shortest =
      short_cell * std::min(tolerance_.position, metres_per_radian * tolerance_.orientation);
  if (straight || depth == max_halvings || length * (b - a) <= shortest) {
    nodes_.push_back(b);
    return;
  }
  const double middle = 0.5 * (a + b);
  divide(a, middle, depth + 1);
  divide(middle, b, depth + 1);
}

double PathTracker::distance(const Pose& a, const Pose& b) const {
  return weighted(task_deviation(task_, a, b));
}

Pose PathTracker::pose(double s) const { return pose_at(path_, s); }

double PathTracker::distance_at(const Pose& pose, double s) const {
  return distance(pose_at(path_, s), pose);
}

/// The deviation as a fraction of the tolerance.
double PathTracker::excess(const Pose& pose, double s) const {
  const Deviation deviation = task_deviation(task_, pose_at(path_, s), pose);
  return std::max(deviation.position / tolerance_.position,
                  deviation.orientation / tolerance_.orientation);
}

/// The next end of a cell, not beyond `end`.
double PathTracker::next_node(double s, bool up, double end) const {
  if (up) {
    const auto next = std::upper_bound(nodes_.begin(), nodes_.end(), s);
    return next == nodes_.end() ? end : std::min(*next, end);
  }
  const auto next = std::lower_bound(nodes_.begin(), nodes_.end(), s);
  return next == nodes_.begin() ? end : std::max(*(next - 1), end);
}

/// Half the derivative of the squared distance at s, in the cell between s and `beside`.
double PathTracker::slope(const Pose& pose, double s, double beside) const {
  const auto k = std::min(static_cast<std::size_t>(0.5 * (s + beside)), path_.segments.size() - 1);
  const PoseMotion motion = motion_at(path_.segments[k], s - static_cast<double>(k));
  return -weighted_rows(task_, pose_difference(pose, motion.pose))
              .dot(weighted_rows(task_, motion.velocity));
}

/// The first local minimum from `from` towards `end`, which may be before it: where the slope
/// changes its sign in a cell or between two. `from` itself counts where `start` is set.
std::optional<PathTracker::NearPoint> PathTracker::minimum(const Pose& pose, double from,
                                                           double end, bool start) const {
  const bool up = end >= from;
  bool descending = start;
  for (double here = from; here != end;) {
    const double next = next_node(here, up, end), direction = up ? 1 : -1;
    const double first = direction * slope(pose, here, next);
    if (first >= 0 && descending) return NearPoint{here, distance_at(pose, here), here};
    const double last = direction * slope(pose, next, here);
    if (first < 0 && last > 0) {
      const double s = refined(pose, here, next);
      return NearPoint{s, distance_at(pose, s), next};
    }
    descending = last <= 0;
    here = next;
  }
  if (descending) return NearPoint{end, distance_at(pose, end), end};
  return {};
}

/// Minimises the distance in a cell by Gauss-Newton on its square, or by bisection of the slope
/// where that leaves the interval in which the slope changes its sign. Convergence is quadratic for
/// a pose on the path, linear far from it, where the last digits of s do not matter.
double PathTracker::refined(const Pose& pose, double a, double b) const {
  constexpr int max_steps = 40;
  double low = std::min(a, b), high = std::max(a, b), s = 0.5 * (low + high);
  const auto k = std::min(static_cast<std::size_t>(s), path_.segments.size() - 1);
  for (int i = 0; i < max_steps; ++i) {
    const PoseMotion motion = motion_at(path_.segments[k], s - static_cast<double>(k));
    const Twist rate = weighted_rows(task_, motion.velocity);
    const double downwards = weighted_rows(task_, pose_difference(pose, motion.pose)).dot(rate);
    (downwards > 0 ? low : high) = s;
    const double square = rate.squaredNorm();
    double next = square > 0 ? s + downwards / square : low - 1;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool converged = std::abs(next - s) <= 1e-15 * std::max(1.0, s);
    s = next;
    if (converged) break;
  }
  return s;
}

double PathTracker::nearest(const Pose& pose, double from) const {
  const std::size_t last = segment_at(path_, to_);
  const auto begin = static_cast<double>(last);
  const auto* line = std::get_if<Line>(&path_.segments[last]);
  if (line != nullptr && from >= begin) {
    return std::clamp(begin + nearest_fraction(*line, pose, task_), from, to_);
  }
  const auto found = minimum(pose, from, to_, true);
  return found ? found->s : to_;
}

/// A parameter near a local minimum at which the pose is within the tolerance.
std::optional<double> PathTracker::fit_near(const Pose& pose, const NearPoint& at, double low,
                                            double high) const {
  if (excess(pose, at.s) <= 1) return at.s;
  constexpr double rounding = 1 + 1e-9;
  if (at.distance > rounding * weighted(tolerance_)) return {};
  constexpr int intervals = 16, sections = 36;  // to 1e-9 of a segment
  const Minimum fitted =
      scan_and_refine(std::max(low, at.s - stride), std::min(high, at.s + stride), intervals,
                      sections, [&](double s) { return excess(pose, s); });
  if (fitted.value <= 1) return fitted.x;
  return {};
}

/// The first parameter from `from` towards `end` at which the pose is within the tolerance, near a
/// local minimum. `resume` becomes the parameter from which on the next one is sought.
std::optional<double> PathTracker::fit(const Pose& pose, double from, double end, double farthest,
                                       double& resume, bool start) const {
  const double low = std::min(from, end), high = std::max(from, end);
  for (resume = from;; start = false) {
    const double begin = resume;
    const auto at = minimum(pose, begin, end, start);
    if (!at) return {};
    resume = at->resume;
    const auto found = fit_near(pose, *at, low, high);
    if (found) return found;
    // On a slow path position and orientation may be nearest far from one another.
    for (double s = begin; at->distance <= weighted(tolerance_);) {
      if (within_tolerance(pose, s)) return s;
      const bool passed = end >= begin ? s > at->s : s < at->s;
      if (s == end || std::abs(s - from) > farthest) break;
      if (passed && distance_at(pose, s) > weighted(tolerance_)) break;
      s = next_node(s, end >= begin, end);
    }
    if (at->s == end || std::abs(at->s - from) > farthest) return {};
  }
}

std::optional<double> PathTracker::first_fit(const Pose& pose, double from) const {
  double resume = from;
  return fit(pose, from, to_, farthest_fit, resume, true);
}

/// A parameter within the tolerance near the boundary between two, by bisection.
double PathTracker::boundary(const Pose& pose, double outside, double inside) const {
  constexpr int halvings = 6;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (outside + inside);
    (within_tolerance(pose, middle) ? inside : outside) = middle;
  }
  return inside;
}

std::optional<double> PathTracker::first_within(const Pose& pose, double from) const {
  if (within_tolerance(pose, from)) return from;
  const auto found = first_fit(pose, from);
  if (!found) return {};
  return boundary(pose, from, *found);
}

double PathTracker::last_within(const Pose& pose, double from, double to) const {
  if (from <= to || within_tolerance(pose, from)) return std::max(from, to);
  double resume = from;
  const auto found = fit(pose, from, to, from - to, resume, true);
  return found ? boundary(pose, from, *found) : to;
}

std::vector<double> PathTracker::fits(const Pose& pose, double from, double to) const {
  std::vector<double> all;
  double resume = from;
  while (all.size() < max_fits) {
    const auto found = fit(pose, resume, to, to - from, resume, all.empty());
    if (!found) break;
    if (all.empty() || *found > all.back()) all.push_back(*found);
    if (*found >= to || resume >= to) break;
  }
  return all;
}

double PathTracker::length(double from, double to) const {
  const auto up_to = [&](double s) {
    const auto next = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, s);
    const auto k = static_cast<std::size_t>(next - nodes_.begin());
    const double u = (s - nodes_[k - 1]) / (nodes_[k] - nodes_[k - 1]);
    return lengths_[k - 1] + u * (lengths_[k] - lengths_[k - 1]);
  };
  return up_to(to) - up_to(from);
}

}  // namespace beeline::internal
