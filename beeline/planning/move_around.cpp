#include <algorithm>
#include <ostream>

#include <beeline/planning/free_path.h>
#include <beeline/planning/internal/blended_path.h>
#include <beeline/planning/internal/free_edges.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/timing/internal/timed_section.h>

namespace beeline {

using namespace internal;

namespace {

constexpr int halvings = 5;  // of a blend that is not proved, before it is a stop

/// The blend at an inner waypoint of a path, as large as its neighbours allow.
JointBlend largest_blend(const std::vector<Configuration>& waypoints, std::size_t k, double most) {
  JointBlend blend{waypoints[k - 1], waypoints[k], waypoints[k + 1]};
  const double nearest =
      std::min((blend.at - blend.before).norm(), (blend.after - blend.at).norm());
  blend.radius = std::min(most, 0.5 * nearest);
  return blend;
}

/// Returns the radius of the largest blend, half of it or a quarter and so on, that is proved.
double proved_radius(FreeEdges& edges, const std::vector<std::string>& names, JointBlend blend) {
  if (!(blend.radius > 0) || turns_back(blend)) return 0;
  for (int i = 0; i <= halvings; ++i, blend.radius /= 2) {
    if (edges.is_free(blend.curve(names))) return blend.radius;
  }
  return 0;
}

/// The paths from stop to stop.
std::vector<JointPath> paths_of(const std::vector<Configuration>& waypoints,
                                const std::vector<double>& blends) {
  std::vector<JointPath> paths;
  std::size_t first = 0;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    const bool is_last = k + 1 == waypoints.size();
    if (!is_last && blends[k - 1] > 0) continue;
    const auto at = [](auto& list, std::size_t i) {
      return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    paths.push_back(blended_path({at(waypoints, first), at(waypoints, k + 1)},
                                 {at(blends, first), at(blends, k - 1)}));
    first = k;
  }
  return paths;
}

RetimeOptions timing_of(const FreeMotionOptions& options) {
  return {.profile = options.profile,
          .interpolation = options.interpolation,
          .speed_scale = options.speed_scale,
          .tool_speed = options.tool_speed,
          .rate = options.rate,
          .duration = options.duration,
          .max_samples = options.max_samples};
}

/// A motion of one sample, to a goal that is the start.
Retimed at_rest(const Arm& arm, const Configuration& q) {
  const Configuration none = Configuration::Zero(q.size());
  Retimed timed;
  timed.trajectory = {arm.joint_names(), {0}, {q}, {none}, {none}};
  timed.limits = limit_usage(arm, timed.trajectory);
  return timed;
}

/// The motion along the path of `motion`, timed and proved, or why there is none.
void time_and_prove(const CollisionModel& model, const FreeMotionOptions& options,
                    BudgetMeter& budget, FreeMotion& motion) {
  const Arm& arm = model.arm();
  const std::vector<Configuration>& waypoints = motion.path.waypoints;
  Retimed timed = motion.path.length > 0 ? retimed_paths(arm, paths_of(waypoints, motion.blends),
                                                         timing_of(options), budget)
                                         : at_rest(arm, waypoints.front());
  if (!timed) {
    motion.status =
        budget.complete() ? MotionStatus::outside_limits : status_of<MotionStatus>(budget.ending());
    motion.reason = std::move(timed.reason);
    return;
  }
  motion.clearance =
      prove_clearance(model, timed.trajectory, {.closest = true, .budget = budget.part()});
  motion.reason = motion.clearance.reason;
  if (motion.clearance) {
    motion.status = MotionStatus::reached;
    motion.trajectory = std::move(timed.trajectory);
    motion.limits = timed.limits;
    return;
  }
  motion.status = !budget.complete() ? status_of<MotionStatus>(budget.ending())
                  : motion.clearance.status == ClearanceStatus::collides
                      ? MotionStatus::collides
                      : MotionStatus::not_decided;
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const FreeMotion& motion) {
  out << motion.status;
  if (!motion) return out << ": " << motion.reason;
  return out << " in " << number(motion.duration()) << " s, " << motion.trajectory.size()
             << " samples; " << motion.clearance;
}

FreeMotion move_around(const CollisionModel& model, const Configuration& start,
                       std::span<const Configuration> goals, const FreeMotionOptions& options) {
  if (!(options.joint_blend >= 0)) {
    throw Error("", "joint_blend", " is " + number(options.joint_blend) + "; it must be 0 or more");
  }
  check_options(timing_of(options));
  BudgetMeter budget(options.budget);
  FreeMotion motion;
  motion.path = find_free_path(model, start, goals,
                               {.random_seed = options.random_seed,
                                .max_edges = options.max_edges,
                                .shortcuts = options.shortcuts,
                                .budget = budget.part()});
  motion.status = motion.path.status;
  motion.reason = motion.path.reason;
  if (!motion.path) return motion;
  FreeEdges edges(model, budget);
  const std::vector<Configuration>& waypoints = motion.path.waypoints;
  for (std::size_t k = 1; k + 1 < waypoints.size(); ++k) {
    motion.blends.push_back(proved_radius(edges, model.bodies().joint_names,
                                          largest_blend(waypoints, k, options.joint_blend)));
  }
  time_and_prove(model, options, budget, motion);
  // The trajectory differs from the path by its rounding and by its interpolation between samples.
  const bool is_close =
      motion.status == MotionStatus::not_decided || motion.status == MotionStatus::collides;
  if (is_close && std::any_of(motion.blends.begin(), motion.blends.end(),
                              [](double radius) { return radius > 0; })) {
    std::fill(motion.blends.begin(), motion.blends.end(), 0);
    time_and_prove(model, options, budget, motion);
  }
  return motion;
}

}  // namespace beeline
