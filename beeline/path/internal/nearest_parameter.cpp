#include <algorithm>
#include <cmath>

#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/nearest_parameter.h>

namespace beeline {
namespace {

constexpr double stride = 1.0 / 32;  // of a segment
constexpr double farthest = 2;       // segments that a tool may pass between two samples
constexpr int max_newton_steps = 30;

/// The rows that matter, turns in metres.
Twist weighted(const Task& task, Twist twist) {
  twist = masked(task, twist);
  twist.tail<3>() *= metres_per_radian;
  return twist;
}

double distance(const ToolPath& path, const Task& task, const Pose& pose, double place) {
  const Deviation off = task_deviation(task, pose_at(path, place), pose);
  return std::hypot(off.position, metres_per_radian * off.orientation);
}

}  // namespace

double nearest_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to) {
  const std::size_t on = segment_at(path, to);
  const auto begin = static_cast<double>(on);
  const auto* line = std::get_if<Line>(&path.segments[on]);
  if (line != nullptr && from >= begin) {
    return std::clamp(begin + nearest_fraction(*line, pose, task), from, to);
  }
  double place = from, low = from, high = to, least = distance(path, task, pose, from);
  for (double next = from; next < to;) {
    next = std::min(next + stride, to);
    const double there = distance(path, task, pose, next);
    if (there > least) {
      high = next;
      break;
    }
    low = place, place = next, least = there;
  }
  const double scanned = place;
  for (int i = 0; i < max_newton_steps; ++i) {                            // Gauss and Newton's
    const std::size_t k = std::min(static_cast<std::size_t>(place), on);  // of two the one ahead
    const SegmentMotion motion = motion_at(path.segments[k], place - static_cast<double>(k));
    const Twist rate = weighted(task, motion.velocity);
    const Twist left = weighted(task, pose_difference(pose, motion.pose));
    const double square = rate.squaredNorm();
    if (!(square > 0)) break;
    const double before = place;
    place = std::clamp(place + left.dot(rate) / square, low, high);
    if (std::abs(place - before) <= 1e-15 * std::max(1.0, place)) break;
  }
  return distance(path, task, pose, place) <= least ? place : scanned;
}

double fitting_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to, const Deviation& tolerance) {
  constexpr int looks = 16, thirds = 40;
  const auto share = [&](double place) {
    const Deviation off = task_deviation(task, pose_at(path, place), pose);
    return std::max(off.position / tolerance.position, off.orientation / tolerance.orientation);
  };
  const auto fitted = [&](double nearest) {
    double low = std::max(from, nearest - stride), high = std::min(to, nearest + stride);
    double best = nearest;
    const double step = (high - low) / looks;
    for (int i = 0; i <= looks; ++i) {
      if (share(low + i * step) < share(best)) best = low + i * step;
    }
    low = std::max(low, best - step), high = std::min(high, best + step);
    for (int i = 0; i < thirds; ++i) {
      const double third = (high - low) / 3;
      const bool falls = share(low + third) > share(high - third);
      (falls ? low : high) += falls ? third : -third;
    }
    return (low + high) / 2;
  };
  const double nearest = nearest_parameter(path, task, pose, from, to);
  if (share(nearest) <= 1) return nearest;
  const double place = fitted(nearest);
  if (share(place) <= 1) return place;
  for (double begin = nearest + stride; begin < std::min(to, from + farthest); begin += stride) {
    const double next = nearest_parameter(path, task, pose, begin, to);
    if (share(next) <= 1) return next;
    begin = std::max(begin, next);
  }
  return nearest;
}

}  // namespace beeline
