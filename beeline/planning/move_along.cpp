#include <algorithm>
#include <cmath>
#include <ostream>

#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/timed_plan.h>
#include <beeline/planning/move_along.h>
#include <beeline/planning/plan.h>

namespace beeline {
namespace {

constexpr double least_tolerance = 1e-8;  // below, rounding at the samples would use it up
constexpr double margin = 0.9;            // of the tolerance that the plan may use
constexpr double finer = 1.0 / 64;        // of that, where a motion must keep nearer to its samples

/// Throws Error for tolerances, speeds, rates or numbers of samples that make no sense.
void check_options(const PathMotionOptions& options) {
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
  if (options.max_samples < 2) {
    throw Error("max_samples is " + std::to_string(options.max_samples) + "; a line needs two");
  }
}

/// Why a finished motion is not within the tolerances by proof; empty where it is.
std::string not_proved(const PathDeviation& deviation, const PathMotionOptions& options) {
  const Deviation& bound = deviation.bound;
  if (bound.position <= options.tolerance && bound.orientation <= options.orientation_tolerance) {
    return {};
  }
  return "the tool is only proved to stay within " + number(bound.position) + " m and " +
         number(bound.orientation) + " rad of its way; allow a larger tolerance";
}

/// The same arm with its limits that much closer, but not beyond `start`.
Arm held_back(const Arm& arm, const std::optional<Configuration>& start, double inset) {
  std::vector<Joint> joints = arm.joints();
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
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

/// The start without what rounding has it beyond limits. Throws Error where that is more.
Configuration checked_start(const Arm& arm, const Configuration& start) {
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  const internal::Bounds bounds = internal::bounds_of(arm);
  return start.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
}

/// A planned path as a motion, or why there is none.
PathMotion timed(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                 const PathMotionOptions& options) {
  PathMotion motion;
  motion.status = plan.status;
  motion.reason = plan.reason;
  if (plan.status != MotionStatus::reached) return motion;
  TimedPlan timed = timed_plan(
      arm, route, plan, task,
      {.profile = options.profile, .tool_speed = options.tool_speed, .rate = options.rate});
  motion.status = timed.status;
  motion.reason = timed.reason;
  if (motion.status == MotionStatus::reached) {
    const auto fault = first_joint_fault(arm, timed.trajectory);
    if (fault && fault->kind == Fault::limits) {
      motion.status = MotionStatus::outside_limits;
      motion.reason = fault->reason;
    }
  }
  motion.trajectory = std::move(timed.trajectory);
  motion.path_parameters = std::move(timed.path_parameters);
  motion.limit_margin = plan.limit_margin;
  motion.dexterity = plan.dexterity;
  return motion;
}

/// Measures the finished motion; one that is not proved is none.
void prove(const Arm& arm, const Route& route, const Task& task, const PathMotionOptions& options,
           PathMotion& motion) {
  motion.path = route.path;
  motion.arrivals = arrivals(motion.path_parameters);
  motion.deviation =
      path_deviation(arm, motion.trajectory.positions, motion.path_parameters, route.path, task);
  motion.limits = limit_usage(motion.trajectory, arm);
  motion.reason = not_proved(motion.deviation, options);
  if (motion.reason.empty()) return;
  motion.status = MotionStatus::not_converged;
  if (options.rate > 0) {
    motion.reason = "at " + number(options.rate) + " samples a second " + motion.reason +
                    ", ask for a higher rate or a lower speed";
  }
}

PathMotion move(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                const PathMotionOptions& options) {
  const Task task = options.task.value_or(default_task(arm));
  // Samples that have to be close for the bound already make a close spline.
  const double share = options.rate > 0 && !bound_is_linear(arm, task) ? finer : margin;
  const BranchOptions planning{
      .task = task,
      .tolerance = {share * options.tolerance, share * options.orientation_tolerance},
      .max_samples = static_cast<std::size_t>(options.max_samples),
      .progress = options.progress};
  const Branch plan = plan_path(arm, start, route.path, planning);
  PathMotion motion = timed(arm, route, plan, task, options);
  // A smooth motion of a joint that goes along its limit for a while may pass it between samples.
  if (plan.status == MotionStatus::reached && motion.status == MotionStatus::outside_limits) {
    const std::pair<double, double> attempts[] = {{1e-3, 1}, {1e-2, 1}, {1e-3, finer}};
    for (const auto& [inset, part] : attempts) {
      BranchOptions again = planning;
      again.tolerance.position *= part;
      again.tolerance.orientation *= part;
      Branch other = plan_path(held_back(arm, start, inset), start, route.path, again);
      if (other.status == MotionStatus::reached) measure(arm, task, other);
      PathMotion better = timed(arm, route, other, task, options);
      if (better.status != MotionStatus::reached) continue;
      motion = std::move(better);
      break;
    }
  }
  if (motion.status == MotionStatus::reached) prove(arm, route, task, options, motion);
  if (motion.status == MotionStatus::reached) return motion;
  PathMotion none;
  none.status = motion.status;
  none.reason = motion.reason;
  BranchOptions looking = planning;  // without the samples that only a rate needs
  looking.tolerance = {margin * options.tolerance, margin * options.orientation_tolerance};
  for (const bool turns : {false, true}) {
    const bool quick = arm.dof() <= task.size() + 1;  // else each look takes long
    if (!options.suggest || !quick || plan.status == MotionStatus::reached) break;
    auto near = nearby_path(arm, start, route.path, looking, turns);
    if (near) none.nearby.push_back(std::move(*near));
  }
  return none;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const PathMotion& motion) {
  out << name(motion.status);
  if (motion.status != MotionStatus::reached) return out << ": " << motion.reason;
  return out << " in " << number(motion.trajectory.times.back()) << " s, "
             << motion.trajectory.size() << " samples, deviation at most "
             << motion.deviation.bound;
}

PathMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const PathMotionOptions& options) {
  constexpr double elsewhere = 1e-8;  // metres and radians
  check_options(options);
  const Task task = options.task.value_or(default_task(arm));
  check_route(arm, route, task);
  std::optional<Configuration> from;
  if (start) {
    from = checked_start(arm, *start);
    const Pose tool = forward_kinematics(arm, *from);
    const Deviation off = task_deviation(task, pose_at(route.path, 0), tool);
    if (!within(off, {elsewhere, elsewhere})) {
      throw Error("the motion cannot start: the tool is " + number(off.position) + " m and " +
                  angle(off.orientation) + " away from the path's begin");
    }
  }
  return move(arm, from, route, options);
}

PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options) {
  check_options(options);
  std::vector<Pose> poses = checked_waypoints(waypoints);
  const Configuration q = checked_start(arm, start);
  poses.insert(poses.begin(), forward_kinematics(arm, q));
  return move_along(arm, q, route_of(lines_through(poses), PathKind::line), options);
}

PathMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const PathMotionOptions& options) {
  check_options(options);
  PathMotion motion =
      move_along(arm, std::nullopt, route_of(lines_through(poses), PathKind::line), options);
  if (!motion.arrivals.empty()) motion.arrivals.insert(motion.arrivals.begin(), 0);
  return motion;
}

}  // namespace beeline
