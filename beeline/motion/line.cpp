#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/descent/numerical.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/joint_faults.h>
#include <beeline/motion/line.h>
#include <beeline/motion/plan.h>
#include <beeline/motion/timed_samples.h>
#include <beeline/motion/waypoints.h>

namespace beeline {
namespace {

constexpr double least_tolerance = 1e-8;  // below, rounding at the samples would use it up
constexpr double margin = 0.9;            // of the tolerance that the plan may use
constexpr double finer = 1.0 / 64;        // of that, where a motion must keep nearer to its samples

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
    const auto brought = [&](Trajectory& line) {
      put_on_line(arm, {poses[w], poses[w + 1]}, task, line);
    };
    motion.reason = append_timed(motion.trajectory, arm, way.samples, retiming, brought);
    if (!motion.reason.empty()) {
      motion.reason = "line " + std::to_string(w + 1) + ": " + motion.reason;
      motion.status = MotionStatus::outside_limits;
      return;
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
    motion.reason = not_proved(motion.straightness, options);
    if (!motion.reason.empty()) {
      motion.status = MotionStatus::not_converged;
      if (options.rate > 0) {
        motion.reason = "at " + number(options.rate) + " samples a second " + motion.reason +
                        ", ask for a higher rate or a lower speed";
      }
    }
  }
  if (motion.status != MotionStatus::reached) {
    LineMotion none;
    none.status = motion.status;
    none.reason = motion.reason;
    for (const bool turns : {false, true}) {
      const bool quick = arm.dof() <= task.size() + 1;  // else each look takes long
      if (!options.suggest || !quick || plan.status == MotionStatus::reached) break;
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

std::string not_proved(const Straightness& straightness, const LineOptions& options) {
  const Deviation& bound = straightness.bound;
  if (bound.position <= options.tolerance && bound.orientation <= options.orientation_tolerance) {
    return {};
  }
  return "the tool is only proved to stay within " + number(bound.position) + " m and " +
         number(bound.orientation) + " rad of its way; allow a larger tolerance";
}

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
