#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/line.h>
#include <beeline/motion/line_failure.h>
#include <beeline/motion/redundancy.h>
#include <beeline/motion/time_law.h>

namespace beeline {
namespace {

constexpr double sample_tolerance = 1e-11;  // metres and radians that a sample may be off the line
constexpr double longest_step = 1.0 / 64;  // of a line's time: the time law needs that many samples
constexpr double shortest_step = 1e-7;     // of a line's time: below it the arm has to jump
constexpr double largest_turn = 0.1;       // of one joint in one step, radians
constexpr double no_motion = 1e-9;         // metres or radians: the tool is there already

/// One straight line being followed: everything that one step needs.
struct Follower {
  const Arm& arm;
  const LineOptions& options;
  Task task;
  Bounds bounds;
  Line line;

  /// The configuration at the fraction `u` of the line's time, next to q; none when there is none
  /// or the motion to it is not proved to stay near the line.
  std::optional<Configuration> step(const Configuration& q, double u) const {
    const Pose target = interpolate(line.from, line.to, rest_to_rest(u));
    const Configuration guess = predicted(arm, q, target, task, bounds);
    const Descent found = descend(arm, target, task, bounds, guess,
                                  {.tolerance = sample_tolerance, .iterations = 30});
    if (!found.converged) return {};
    for (int k = 0; k < arm.dof(); ++k) {
      const bool turns = kind(arm.joint_of(k)) != JointKind::prismatic;
      if (turns && std::abs(found.q[k] - q[k]) > largest_turn) return {};
    }
    const Deviation small{sample_tolerance, sample_tolerance};
    const Deviation bound = step_bound(arm, line, task, q, found.q, small, small);
    const bool proved =
        bound.position <= options.tolerance && bound.orientation <= options.orientation_tolerance;
    return proved ? std::optional(found.q) : std::nullopt;
  }
};

struct Followed {
  std::vector<Configuration> samples;
  std::vector<double> fractions;  ///< of the line's time, 0 first; 1 last when it came through
  bool through() const { return fractions.back() == 1; }
};

Followed follow(const Follower& follower, const Configuration& start, std::size_t most_samples,
                const std::function<void(double)>& progress) {
  Followed way{{start}, {0}};
  double length = longest_step;
  while (!way.through() && length >= shortest_step && way.samples.size() < most_samples) {
    const double u = std::min(1.0, way.fractions.back() + length);
    if (const auto next = follower.step(way.samples.back(), u)) {
      way.samples.push_back(*next);
      way.fractions.push_back(u);
      length = std::min(1.5 * length, longest_step);
      if (progress && way.samples.size() % 64 == 0) progress(u);
    } else {
      length /= 2;
    }
  }
  return way;
}

void check_options(const Arm& arm, const Configuration& start, std::span<const Pose> waypoints,
                   const LineOptions& options) {
  check_configuration(arm, start);
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  if (waypoints.empty()) throw Error("a line needs at least one waypoint");
  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    if (!waypoints[w].matrix().allFinite()) {
      throw Error("waypoint " + std::to_string(w + 1) + " is not finite");
    }
  }
  for (const double positive :
       {options.tolerance, options.orientation_tolerance, options.tool_speed}) {
    if (!(positive > 1e-9)) {
      throw Error("tolerances and the tool's speed must be above 1e-9, not " + number(positive));
    }
  }
  if (options.most_samples < 2) throw Error("a line needs at least two samples");
}

}  // namespace

LineMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const LineOptions& options) {
  check_options(arm, start, waypoints, options);
  const Task task = options.task.value_or(default_task(arm));
  Follower follower{arm, options, task, bounds_of(arm), {forward_kinematics(arm, start), {}}};
  LineMotion motion;
  Configuration q = start.cwiseMax(follower.bounds.lower).cwiseMin(follower.bounds.upper);
  motion.trajectory = at_rest(arm, q);

  for (std::size_t w = 0; w < waypoints.size(); ++w) {
    follower.line.to = waypoints[w];
    const Deviation ahead = task_deviation(task, waypoints[w], follower.line.from);
    if (ahead.position > no_motion || ahead.orientation > no_motion) {
      const auto told = [&](double u) {
        options.progress((static_cast<double>(w) + u) / static_cast<double>(waypoints.size()));
      };
      const std::size_t left =
          static_cast<std::size_t>(options.most_samples) - motion.trajectory.size();
      const Followed way =
          follow(follower, q, left, options.progress ? told : std::function<void(double)>());
      if (!way.through()) {
        const bool full = way.samples.size() >= left;
        const LineFailure failure =
            full ? too_many_samples(options.most_samples)
                 : line_failure(arm, follower.line, task, way.samples.back(), way.fractions.back());
        return {.status = failure.status,
                .reason = "line " + std::to_string(w + 1) + " of " +
                          std::to_string(waypoints.size()) + " " + failure.reason,
                .trajectory = {},
                .arrivals = {},
                .straightness = {}};
      }
      q = way.samples.back();
      // The time law's speed is 15/8 of the mean where it is largest.
      const double shortest = 15.0 / 8 * ahead.position / options.tool_speed;
      append_timed(motion.trajectory, arm, way.samples, way.fractions, shortest);
    }
    motion.arrivals.push_back(motion.trajectory.size() - 1);
    follower.line.from = waypoints[w];
  }
  motion.straightness =
      straightness(arm, motion.trajectory.positions, waypoints, motion.arrivals, task);
  motion.status = MotionStatus::reached;
  return motion;
}

}  // namespace beeline
