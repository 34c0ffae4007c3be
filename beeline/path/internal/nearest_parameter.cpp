#include <algorithm>
#include <cmath>

#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/minimise.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/nearest_parameter.h>

namespace beeline::internal {
namespace {

constexpr double stride = 1.0 / 32;  // of a segment: see the header
constexpr double farthest = 2;       // segments that the tool may pass between two samples

/// Convergence is quadratic for a pose on the path, linear far from it, where the last digits of s
/// do not matter.
constexpr int max_newton_steps = 30;

/// The components that the task constrains, rotations in metres.
Twist weighted(const Task& task, Twist twist) {
  twist = masked(task, twist);
  twist.tail<3>() *= metres_per_radian;
  return twist;
}

double distance(const ToolPath& path, const Task& task, const Pose& pose, double s) {
  const Deviation deviation = task_deviation(task, pose_at(path, s), pose);
  return std::hypot(deviation.position, metres_per_radian * deviation.orientation);
}

/// Minimises the distance over s in [low, high] from `s`, by Gauss-Newton on its square.
double refined(const ToolPath& path, const Task& task, const Pose& pose, double s, double low,
               double high, std::size_t last) {
  for (int i = 0; i < max_newton_steps; ++i) {
    const std::size_t k = std::min(static_cast<std::size_t>(s), last);  // where two meet, the next
    const PoseMotion motion = motion_at(path.segments[k], s - static_cast<double>(k));
    const Twist rate = weighted(task, motion.velocity);
    const Twist error = weighted(task, pose_difference(pose, motion.pose));
    const double square = rate.squaredNorm();
    if (!(square > 0)) break;
    const double before = s;
    s = std::clamp(s + error.dot(rate) / square, low, high);
    if (std::abs(s - before) <= 1e-15 * std::max(1.0, s)) break;
  }
  return s;
}

}  // namespace

double nearest_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to) {
  const std::size_t last = segment_at(path, to);
  const auto begin = static_cast<double>(last);
  const auto* line = std::get_if<Line>(&path.segments[last]);
  if (line != nullptr && from >= begin) {
    return std::clamp(begin + nearest_fraction(*line, pose, task), from, to);
  }
  double scanned = from, low = from, high = to, smallest = distance(path, task, pose, from);
  for (double next = from; next < to;) {
    next = std::min(next + stride, to);
    const double there = distance(path, task, pose, next);
    if (there > smallest) {
      high = next;
      break;
    }
    low = scanned;
    scanned = next;
    smallest = there;
  }
  const double s = refined(path, task, pose, scanned, low, high, last);
  return distance(path, task, pose, s) <= smallest ? s : scanned;
}

double fitting_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to, const Deviation& tolerance) {
  const auto excess = [&](double s) {
    const Deviation deviation = task_deviation(task, pose_at(path, s), pose);
    return std::max(deviation.position / tolerance.position,
                    deviation.orientation / tolerance.orientation);
  };
  const double nearest = nearest_parameter(path, task, pose, from, to);
  if (excess(nearest) <= 1) return nearest;
  constexpr int intervals = 16, sections = 36;  // to 1e-9 of a segment
  const Minimum fitted =
      scan_and_refine(std::max(from, nearest - stride), std::min(to, nearest + stride), intervals,
                      sections, excess);
  if (fitted.value <= 1) return fitted.x;
  for (double begin = nearest + stride; begin < std::min(to, from + farthest); begin += stride) {
    const double next = nearest_parameter(path, task, pose, begin, to);
    if (excess(next) <= 1) return next;
    begin = std::max(begin, next);
  }
  return nearest;
}

}  // namespace beeline::internal
