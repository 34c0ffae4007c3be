#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/descent/numerical.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/chord.h>
#include <beeline/motion/joint_faults.h>
#include <beeline/motion/line.h>
#include <beeline/motion/plan.h>
#include <beeline/motion/waypoints.h>

namespace beeline {
namespace {

constexpr double least_tolerance = 1e-8;  // below, rounding at the samples would use it up
constexpr double margin = 0.9;            // of the tolerance that the plan may use
constexpr double finer = 1.0 / 64;        // of that, where a motion must keep nearer to its samples

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
  if (!(options.rate >= 0) || !std::isfinite(options.rate)) {
    throw Error("the rate must be zero or above, not " + number(options.rate) +
                " samples a second");
  }
  if (options.most_samples < 2) {
    throw Error("most samples is " + std::to_string(options.most_samples) + "; a line needs two");
  }
}

/// Of the retimed motion, the samples that were asked for: they are all there, in order.
Trajectory only_samples(const Trajectory& timed, std::span<const Configuration> samples) {
  Trajectory kept{timed.joint_names, {}, {}, {}, {}};
  std::size_t next = 0;
  for (std::size_t k = 0; k < timed.size() && next < samples.size(); ++k) {
    if (timed.positions[k] != samples[next]) continue;
    kept.times.push_back(timed.times[k]);
    kept.positions.push_back(timed.positions[k]);
    kept.velocities.push_back(timed.velocities[k]);
    kept.accelerations.push_back(timed.accelerations[k]);
    do ++next;
    while (next < samples.size() && samples[next] == samples[next - 1]);
  }
  return kept;
}

/// The samples at equal times are on the spline through the exact ones: each is brought onto the
/// line, where the tool is nearest.
void put_on_line(const Arm& arm, const Line& line, const Task& task, Trajectory& timed) {
  const Bounds bounds = bounds_of(arm);
  for (std::size_t k = 1; k + 1 < timed.size(); ++k) {
    const Pose target = nearest_on(line, forward_kinematics(arm, timed.positions[k]), task);
    const Descent found = descend(arm, target, task, bounds, timed.positions[k]);
    if (found.converged) timed.positions[k] = found.q;
  }
}

/// The most speed of the tool's origin between samples: joints in proportion, its velocity differs
/// from the mean by half its largest change, which is 4 times what leaves the chord.
double largest_speed(const Arm& arm, const Trajectory& timed) {
  double largest = 0;
  Vector3 before = forward_kinematics(arm, timed.positions.front()).translation();
  for (std::size_t k = 1; k < timed.size(); ++k) {
    const Vector3 now = forward_kinematics(arm, timed.positions[k]).translation();
    const ChordBound step = chord_bound(arm, timed.positions[k - 1], timed.positions[k]);
    const double dt = timed.times[k] - timed.times[k - 1];
    largest = std::max(largest, ((now - before).norm() + 4 * step.position) / dt);
    before = now;
  }
  return largest;
}

void slow_down(Trajectory& timed, double factor) {
  if (factor <= 1) return;
  for (double& t : timed.times) t *= factor;
  for (Configuration& v : timed.velocities) v /= factor;
  for (Configuration& a : timed.accelerations) a /= factor * factor;
}

void append(Trajectory& trajectory, const Trajectory& more) {
  const double start = trajectory.times.back();
  for (std::size_t k = 1; k < more.size(); ++k) {
    trajectory.times.push_back(start + more.times[k]);
    trajectory.positions.push_back(more.positions[k]);
    trajectory.velocities.push_back(more.velocities[k]);
    trajectory.accelerations.push_back(more.accelerations[k]);
  }
}

/// The same arm with its limits that much closer, but not beyond `start`.
Arm held_back(const Arm& arm, const std::optional<Configuration>& start, double inset) {
  std::vector<Joint> joints = arm.joints();
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits()[static_cast<std::size_t>(k)];
    const double less = std::min(inset, 0.05 * (limits.upper - limits.lower));
    Limits& held = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
                     return joint.name == arm.joint_of(k).name;
                   })->limits;
    held.lower = limits.lower + less;
    held.upper = limits.upper - less;
    if (!start) continue;
    held.lower = std::min(held.lower, (*start)[k]);
    held.upper = std::max(held.upper, (*start)[k]);
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

/// Gives the planned lines their times. Throws nothing for a plan that goes through.
void time_lines(const Arm& arm, std::span<const Pose> poses, const Branch& plan, const Task& task,
                const LineOptions& options, LineMotion& motion) {
  const RetimeOptions retiming{
      .law = options.law, .tool_speed = options.tool_speed, .rate = options.rate};
  motion.trajectory = at_rest(arm, plan.start);
  motion.arrivals = {0};
  for (std::size_t w = 0; w < plan.lines.size(); ++w) {
    const Followed& way = plan.lines[w];
    const bool moves = std::any_of(way.samples.begin(), way.samples.end(),
                                   [&](const auto& q) { return q != way.samples.front(); });
    if (moves) {
      const Retimed timed =
          retime(arm, Trajectory{arm.joint_names(), way.fractions, way.samples, {}, {}}, retiming);
      if (!timed.found()) {
        motion.reason = "line " + std::to_string(w + 1) + ": " + timed.reason;
        motion.status = MotionStatus::outside_limits;
        return;
      }
      Trajectory line = timed.trajectory;
      if (options.rate > 0) {
        put_on_line(arm, {poses[w], poses[w + 1]}, task, line);
      } else {
        line = only_samples(timed.trajectory, way.samples);
      }
      const double speed = std::isfinite(options.tool_speed) ? largest_speed(arm, line) : 0;
      slow_down(line, std::max(speed / options.tool_speed,
                               slower_by_positions(arm, line, keeps_jerk(timed.law))));
      append(motion.trajectory, line);
    }
    motion.arrivals.push_back(motion.trajectory.size() - 1);
  }
  motion.status = MotionStatus::reached;
}

/// A planned line as a motion, or why there is none.
LineMotion timed(const Arm& arm, std::span<const Pose> poses, const Branch& plan, const Task& task,
                 const LineOptions& options) {
  LineMotion motion;
  motion.status = plan.status;
  motion.reason = plan.reason;
  if (plan.status != MotionStatus::reached) return motion;
  time_lines(arm, poses, plan, task, options, motion);
  if (motion.status != MotionStatus::reached) return motion;
  const auto fault = first_joint_fault(arm, motion.trajectory);
  if (fault && fault->kind == Fault::limits) {
    motion.status = MotionStatus::outside_limits;
    motion.reason = fault->reason;
  }
  return motion;
}

LineMotion move(const Arm& arm, const std::optional<Configuration>& start,
                const std::vector<Pose>& poses, const LineOptions& options) {
  const Task task = options.task.value_or(default_task(arm));
  const double share = options.rate > 0 ? finer : margin;
  const BranchOptions planning{
      .task = task,
      .tolerance = {share * options.tolerance, share * options.orientation_tolerance},
      .most_samples = static_cast<std::size_t>(options.most_samples),
      .progress = options.progress};
  Branch plan = plan_lines(arm, start, poses, planning);
  LineMotion motion = timed(arm, poses, plan, task, options);
  // A smooth motion of a joint that goes along its limit for a while may pass it between samples.
  if (plan.status == MotionStatus::reached && motion.status == MotionStatus::outside_limits) {
    const std::pair<double, double> attempts[] = {{1e-3, 1}, {1e-2, 1}, {1e-3, finer}};
    for (const auto& [inset, part] : attempts) {
      BranchOptions again = planning;
      again.tolerance.position *= part;
      again.tolerance.orientation *= part;
      const Branch other = plan_lines(held_back(arm, start, inset), start, poses, again);
      if (other.status != MotionStatus::reached) continue;
      LineMotion better = timed(arm, poses, other, task, options);
      if (better.status != MotionStatus::reached) continue;
      plan = other;
      motion = std::move(better);
      break;
    }
  }
  if (motion.status == MotionStatus::reached) {
    // All the poses: the tool's own first one may differ in rows that do not matter.
    motion.straightness =
        straightness(arm, motion.trajectory.positions, poses, motion.arrivals, task);
    motion.limits = limit_check(motion.trajectory, arm);
    const Deviation& bound = motion.straightness.bound;
    if (bound.position > options.tolerance || bound.orientation > options.orientation_tolerance) {
      motion.status = MotionStatus::not_converged;
      const bool rated = options.rate > 0;
      motion.reason =
          (rated ? "at " + number(options.rate) + " samples a second" : std::string("timed,")) +
          " the tool is only proved to stay within " + number(bound.position) + " m and " +
          number(bound.orientation) + " rad of the line" +
          (rated ? "; ask for a higher rate or a lower speed" : "");
    }
  }
  if (motion.status != MotionStatus::reached) {
    LineMotion none;
    none.status = motion.status;
    none.reason = motion.reason;
    for (const bool turns : {false, true}) {
      if (!options.suggest || plan.status == MotionStatus::reached) break;
      auto near = nearest_lines(arm, start, poses, planning, turns);
      if (near) none.nearby.push_back(std::move(*near));
    }
    return none;
  }
  motion.limit_margin = plan.limit_margin;
  motion.dexterity = plan.dexterity;
  return motion;
}

}  // namespace

LineMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> given_waypoints, const LineOptions& options) {
  check_options(options);
  std::vector<Pose> poses = checked_waypoints(given_waypoints);
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  const Bounds bounds = bounds_of(arm);
  const Configuration q = start.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  poses.insert(poses.begin(), forward_kinematics(arm, q));
  LineMotion motion = move(arm, q, poses, options);
  if (!motion.arrivals.empty()) motion.arrivals.erase(motion.arrivals.begin());
  return motion;
}

LineMotion move_in_lines(const Arm& arm, std::span<const Pose> given_poses,
                         const LineOptions& options) {
  check_options(options);
  if (given_poses.size() < 2) throw Error("a line needs a pose to begin at and one to end at");
  return move(arm, std::nullopt, checked_waypoints(given_poses), options);
}

}  // namespace beeline
