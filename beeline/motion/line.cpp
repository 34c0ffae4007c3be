#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>
#include <beeline/motion/follow.h>
#include <beeline/motion/line.h>
#include <beeline/motion/line_failure.h>
#include <beeline/motion/time_law.h>
#include <beeline/motion/waypoints.h>

namespace beeline {
namespace {

constexpr double least_tolerance = 1e-8;  // below, rounding at the samples would use it up
constexpr double no_motion = 1e-9;        // metres or radians: the tool is there already

void check_options(const LineOptions& options) {
  const std::pair<const char*, double> positives[] = {
      {"tolerance", options.tolerance},
      {"orientation tolerance", options.orientation_tolerance},
      {"tool speed", options.tool_speed}};
  for (const auto& [what, value] : positives) {
    if (!(value >= least_tolerance)) {
      throw Error("the line's " + std::string(what) + " must be at least 1e-8, not " +
                  number(value));
    }
  }
  if (options.most_samples < 2) {
    throw Error("most samples is " + std::to_string(options.most_samples) + "; a line needs two");
  }
  if (options.task && (options.task->size() == 0 || options.task->frame == Frame::space)) {
    throw Error("the task needs at least one row, and the base or the tool frame");
  }
}

/// The most that the tool's origin moves in a unit of the line's time: joints in proportion, its
/// velocity differs from the mean by half its largest change, which is 4 times what leaves the
/// chord.
double largest_speed(const Arm& arm, const Followed& way) {
  double largest = 0;
  Vector3 before = forward_kinematics(arm, way.samples.front()).translation();
  for (std::size_t k = 1; k < way.samples.size(); ++k) {
    const Vector3 now = forward_kinematics(arm, way.samples[k]).translation();
    const double bend = chord_bound(arm, way.samples[k - 1], way.samples[k]).position;
    const double dt = way.fractions[k] - way.fractions[k - 1];
    largest = std::max(largest, ((now - before).norm() + 4 * bend) / dt);
    before = now;
  }
  return largest;
}

/// Configurations on the line, or why there are none; `left` samples may be added.
Followed follow_line(const Arm& arm, const Line& line, const Task& task, const Configuration& start,
                     const LineOptions& options, std::size_t left,
                     const std::function<void(double)>& progress, LineFailure& failure) {
  Followed way = follow(arm, line, task, bounds_of(arm), start,
                        {.tolerance = {options.tolerance, options.orientation_tolerance},
                         .most_samples = left + 1,
                         .progress = progress});
  if (way.through()) return way;
  const bool full = way.samples.size() > left;
  failure = full ? too_many_samples(options.most_samples)
                 : line_failure(arm, line, task, way.samples.back(), way.fractions.back());
  return way;
}

}  // namespace

LineMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> given_waypoints, const LineOptions& options) {
  check_options(options);
  const std::vector<Pose> waypoints = checked_waypoints(given_waypoints);
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  const Task task = options.task.value_or(default_task(arm));
  const Bounds bounds = bounds_of(arm);
  Configuration q = start.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  Line line{forward_kinematics(arm, q), {}};
  LineMotion motion;
  motion.trajectory = at_rest(arm, q);

  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    line.to = waypoints[w];
    const Deviation ahead = task_deviation(task, line.to, line.from);
    if (ahead.position > no_motion || ahead.orientation > no_motion) {
      std::function<void(double)> told;
      if (options.progress) {
        told = [&](double u) {
          options.progress((static_cast<double>(w) + u) / static_cast<double>(waypoints.size()));
        };
      }
      const std::size_t left =
          static_cast<std::size_t>(options.most_samples) - motion.trajectory.size();
      LineFailure failure;
      const Followed way = follow_line(arm, line, task, q, options, left, told, failure);
      if (!way.through()) {
        LineMotion none;
        none.status = failure.status;
        none.reason = "line " + std::to_string(w + 1) + " of " + std::to_string(waypoints.size()) +
                      " " + failure.reason;
        return none;
      }
      q = way.samples.back();
      const bool paced = std::isfinite(options.tool_speed);
      append_timed(motion.trajectory, arm, way.samples, way.fractions,
                   paced ? largest_speed(arm, way) / options.tool_speed : 0);
    }
    motion.arrivals.push_back(motion.trajectory.size() - 1);
    line.from = line.to;
  }
  motion.straightness =
      straightness(arm, motion.trajectory.positions, waypoints, motion.arrivals, task);
  motion.status = MotionStatus::reached;
  return motion;
}

}  // namespace beeline
