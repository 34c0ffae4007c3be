#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_interval.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/certificate/internal/segment_taylor_bound.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/path/internal/consistent_parameters.h>
#include <beeline/path/internal/path_tracker.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline {

using namespace internal;

namespace {

struct Verifier {
  const Arm& arm;
  const Trajectory& trajectory;
  const Route& route;
  Task task;
  Deviation tolerance;
  MovingEnds moving;
  BudgetMeter& budget;
  std::vector<Pose> world_T_tool = {};  ///< at the samples
  Verification result = {};

  bool near(const Deviation& deviation) const { return within(deviation, tolerance); }

  /// Whether the whole segment is within tolerance of its end.
  bool near_its_end(const Segment& segment) const {
    const auto at_end = [&](double s) {
      return near(task_deviation(task, pose_at(segment, s), pose_at(segment, 1)));
    };
    return at_end(0) && at_end(0.25) && at_end(0.5) && at_end(0.75);
  }

  bool is_line(std::size_t i) const { return std::holds_alternative<Line>(route.path.segments[i]); }

  std::string name_of(std::size_t i) const { return segment_name(route.path, i); }

  /// Records a fault, unless an earlier one is recorded.
  void fail(Fault fault, std::size_t k, const std::string& reason) {
    if (result.fault == Fault::none || k < result.sample) record(fault, k, reason);
  }

  void record(Fault fault, std::size_t k, const std::string& reason) {
    result.fault = fault;
    result.sample = k;
    result.time = trajectory.times[k];
    result.reason =
        "at " + number(result.time) + " s, sample " + std::to_string(k + 1) + ": " + reason;
  }

  /// The samples between two stops: path parameters, and the deviation of each from the end as a
  /// fraction of the tolerance, or -1 where the sample is not at the end.
  struct Located {
    std::vector<double> path_parameters, from_end;
    bool reached = false;  ///< the end, by some sample
    bool off = false;      ///< the last one is off the path
  };

  /// Finds the path parameters of the samples from `first` on, from `begin` to the end of
  /// `segment`. Stops at a sample that is off the path, and at one that leaves the segment's end
  /// again. The route's end is an exception: the tool may pass near it before.
  Located locate(std::size_t first, const PathTracker& tracker, double begin,
                 std::size_t segment) const {
    const auto end = static_cast<double>(segment + 1);
    const bool last = segment + 1 == route.path.segments.size();
    const Pose goal = pose_at(route.path.segments[segment], 1);
    const bool line = begin == end - 1 && is_line(segment);
    // The beginning of a closed path is near its end too: only its last half segment is the end.
    double closing = end - 0.5;
    for (std::size_t i = segment + 1; i-- > 0 && near_its_end(route.path.segments[i]);) {
      closing -= 1;
    }
    Located found;
    for (std::size_t k = first; k < trajectory.size(); ++k) {
      if (!last && found.reached && found.from_end.back() < 0) break;
      if (budget.ended()) break;
      const Pose& tool = world_T_tool[k];
      const double from = found.path_parameters.empty() ? begin : found.path_parameters.back();
      const std::optional<double> fit =
          line ? tracker.nearest(tool, from) : tracker.first_within(tool, from);
      const double s = fit.value_or(from);
      found.path_parameters.push_back(s);
      const Deviation left = task_deviation(task, goal, tool);
      // s is the first parameter within the tolerance, not the nearest.
      const bool at_end = near(left) && (line || tracker.first_fit(tool, s).value_or(s) > closing);
      found.from_end.push_back(at_end ? std::max(left.position / tolerance.position,
                                                 left.orientation / tolerance.orientation)
                                      : -1);
      found.reached = found.reached || at_end;
      if (fit) continue;
      found.path_parameters.back() = tracker.nearest(tool, from);
      found.off = true;
      break;
    }
    return found;
  }

  /// Replaces the first path parameters within the tolerance by those that fit best together.
  void make_consistent(const PathTracker& tracker, std::size_t first, Located& found) const {
    std::vector<double>& s = found.path_parameters;
    const auto poses = std::span(world_T_tool).subspan(first);
    const double off = s.back();
    if (found.off && !found.reached) s.pop_back();
    if (!found.reached && s.size() > 1) {
      const std::size_t last = s.size() - 1;
      s[last] = tracker.first_fit(poses[last], s[last]).value_or(s[last]);
    }
    if (s.size() > 1) {
      s = consistent_parameters(
          tracker, poses, s, [&](std::size_t k) { return moved(tracker, first + k); }, &budget);
    }
    if (found.off && !found.reached) s.push_back(std::max(off, s.back()));
  }

  /// Keeps the samples up to the one nearest to the end. It is chosen among the first consecutive
  /// samples that are at the end; at the end of the route, among the last ones.
  static void cut_at_arrival(Located& found, bool last) {
    const std::vector<double>& from_end = found.from_end;
    std::size_t k = 0;
    if (last && from_end.back() >= 0) {
      for (k = from_end.size() - 1; k > 0 && from_end[k - 1] >= 0;) --k;
    }
    while (from_end[k] < 0) ++k;
    std::size_t nearest = k;
    for (; k < from_end.size() && from_end[k] >= 0; ++k) {
      if (from_end[k] < from_end[nearest]) nearest = k;
    }
    found.path_parameters.resize(nearest + 1);
  }

  /// The length of the tool's motion from sample k to the next.
  double moved(const PathTracker& tracker, std::size_t k) const {
    constexpr int chords = 8;
    double length = 0;
    Pose before = world_T_tool[k];
    for (int j = 1; j <= chords; ++j) {
      Configuration q = trajectory.positions[k + 1];
      for (int i = 0; i < arm.dof() && j < chords; ++i) {
        q[i] = interval_polynomial(trajectory, k, i)(static_cast<double>(j) / chords);
      }
      const Pose here = forward_kinematics(arm, q);
      length += tracker.distance(before, here);
      before = here;
    }
    return length;
  }

  /// Returns whether sample k, with this deviation, is within tolerance; records a fault if not.
  bool check_sample(std::size_t k, const Deviation& deviation, const std::string& where) {
    grow(result.deviation.sampled, deviation);
    if (near(deviation)) return true;
    grow(result.deviation.measured, deviation);
    grow(result.deviation.bound, deviation);
    fail(Fault::deviation, k, "the tool is off " + where + " by " + deviation_text(deviation));
    return false;
  }

  bool check_sample(std::size_t k, double s) {
    const std::size_t i = segment_at(route.path, s);
    const Deviation deviation = deviation_from(route.path, s, world_T_tool[k], task);
    if (!check_sample(k, deviation, name_of(i))) return false;
    // Path parameters do not decrease, but the nearest point of a line may lie before s.
    const Deviation back = task_deviation(task, pose_at(route.path, s), world_T_tool[k]);
    if (near(back)) return true;
    fail(Fault::deviation, k,
         "the tool moves backwards on " + name_of(i) + " by " + deviation_text(back));
    return false;
  }

  /// Checks the motion from sample k to the next, or the part of it that is on one segment.
  void check_interval(std::size_t k, const ToolPath& path, const PathInterval& part) {
    constexpr int probes = 64;  // of an interval that fails, to find its largest deviation
    const Segment& segment = path.segments[part.segment];
    auto [measured, bound, along] =
        interval_deviation(arm, segment, task, part.interval, result.deviation.measured, tolerance);
    for (int i = 1; i < probes && !near(bound); ++i) {
      const double u = static_cast<double>(i) / probes;
      Configuration q(arm.dof());
      for (int j = 0; j < arm.dof(); ++j) {
        q[j] = part.interval.coordinates[static_cast<std::size_t>(j)](u);
      }
      const double s = std::clamp(part.interval.s(u), 0.0, 1.0);
      grow(measured, deviation_from(segment, s, forward_kinematics(arm, q), task));
    }
    grow(result.deviation.measured, measured);
    grow(result.deviation.bound, bound);
    if (!near(bound))
      return fail_between(k, std::holds_alternative<Line>(segment), measured, bound);
    check_direction(k, segment, part, along);
  }

  /// Records that the deviation after sample k is not proved to be within tolerance.
  void fail_between(std::size_t k, bool line, const Deviation& measured, const Deviation& bound) {
    const double change =
        (trajectory.positions[k + 1] - trajectory.positions[k]).lpNorm<Eigen::Infinity>();
    const std::string jump =
        change > 0.5 ? "; a joint moves by " + number(change) + ", as at a change of branch" : "";
    const std::string path_name = line ? "line" : "path";
    fail(Fault::deviation, k,
         near(measured) ? "up to the next sample the tool is only proved to stay within " +
                              deviation_text(bound) + " of the " + path_name + jump
                        : "up to the next sample the tool leaves the " + path_name + " by " +
                              deviation_text(measured) + jump);
  }

  /// Records a fault where the tool may move backwards on the path between two samples by more than
  /// the tolerance, as with false velocities: by the largest decrease of s(u), or by the tool's
  /// distance `along` a line from the pose at s(u).
  void check_direction(std::size_t k, const Segment& segment, const PathInterval& part,
                       double along) {
    const double back = largest_decrease(part.interval.s);
    Deviation moved{along, 0};
    if (back > 0) {
      const Extremes range = extremes(part.interval.s);
      const SegmentTaylorBound rates = segment_taylor_bound(segment, std::max(range.smallest, 0.0),
                                                            std::min(range.largest, 1.0));
      if (task.positions() > 0) grow(moved, {back * rates.position.c[1], 0});
      if (task.orientations() > 0) grow(moved, {0, back * rates.rotation.c[1]});
    }
    if (near(moved)) return;
    fail(Fault::deviation, k,
         "up to the next sample the tool moves backwards on " + name_of(part.segment) +
             " by up to " + deviation_text(moved));
  }

  /// Checks the samples that have path parameters, from `first` on, and the steps between them.
  void check_samples(std::size_t first, const std::vector<double>& path_parameters) {
    for (std::size_t i = 0; i < path_parameters.size(); ++i) {
      if (!check_sample(first + i, path_parameters[i])) return;
      if (i > 0) result.path_parameters.push_back(path_parameters[i]);
      if (i + 1 == path_parameters.size() || budget.ended()) return;
      const std::size_t k = first + i;
      const Deviation next =
          deviation_from(route.path, path_parameters[i + 1], world_T_tool[k + 1], task);
      if (!near(next)) continue;  // the next sample's own fault
      for (const PathInterval& part : path_intervals(arm, trajectory, k, route.path, task,
                                                     path_parameters[i], path_parameters[i + 1])) {
        check_interval(k, route.path, part);
      }
      if (result.fault != Fault::none) return;
    }
  }

  /// Checks that the tool stays at the route's end after sample `first`.
  void check_after_end(std::size_t first) {
    const Pose goal = pose_at(route.path.segments.back(), 1);
    const ToolPath stay = lines_through(std::vector{goal, goal});
    for (std::size_t k = first + 1; k < trajectory.size() && result.fault == Fault::none; ++k) {
      if (budget.ended()) return;
      const Deviation left = task_deviation(task, goal, world_T_tool[k]);
      if (near(left)) {
        check_interval(k - 1, stay,
                       path_intervals(arm, trajectory, k - 1, stay, task, 1, 1).front());
      } else {
        fail(Fault::deviation, k, "the tool leaves the last waypoint by " + deviation_text(left));
      }
    }
  }

  void fail_to_reach(std::size_t i) {
    const Deviation left =
        task_deviation(task, pose_at(route.path.segments[i], 1), world_T_tool.back());
    fail(Fault::not_through, trajectory.size() - 1,
         (is_line(i) && route.path.names.empty() ? "waypoint " + std::to_string(i + 1)
                                                 : "the end of " + name_of(i)) +
             " is not reached; at the end the tool is " + deviation_text(left) + " from it");
  }

  /// Locates and checks all samples, from stop to stop.
  void check_route() {
    const std::size_t segments = route.path.segments.size();
    result.path = route.path;
    result.path_parameters = {0};
    std::size_t first = 0, begin = 0;
    check_sample(0, task_deviation(task, pose_at(route.path, 0), world_T_tool[0]),
                 "the path's beginning");
    for (std::size_t i = 0; i < segments && result.fault == Fault::none; ++i) {
      if (i + 1 < segments && !route.stops[i]) continue;
      const PathTracker tracker(route.path, task, static_cast<double>(begin),
                                static_cast<double>(i + 1), tolerance, &budget);
      if (!budget.complete()) break;
      Located found = locate(first, tracker, static_cast<double>(begin), i);
      if (!budget.complete()) break;
      if (found.reached) {
        cut_at_arrival(found, i + 1 == segments);
        found.path_parameters.back() = static_cast<double>(i + 1);
      }
      if (begin < i || !is_line(i)) make_consistent(tracker, first, found);
      if (!budget.complete()) break;
      check_samples(first, found.path_parameters);
      if (!budget.complete()) break;
      if (!found.reached) {
        fail_to_reach(i);
        break;
      }
      if (result.fault == Fault::none) result.path_parameters.back() = found.path_parameters.back();
      first += found.path_parameters.size() - 1;
      begin = i + 1;
    }
    if (result.fault == Fault::none && budget.complete()) check_after_end(first);
    result.arrivals = arrivals(result.path_parameters);
  }

  /// A fault of a joint replaces a deviation at the same time or later.
  void check_joints() {
    constexpr std::size_t stencil = 3;  // samples by which a difference may precede its cause
    const auto fault = first_joint_fault(arm, trajectory, moving, budget.part());
    if (!fault) return;
    const bool position = fault->kind == Fault::limits || fault->kind == Fault::flip;
    if (result.fault == Fault::none ||
        fault->sample + (position ? 0 : stencil + 1) <= result.sample) {
      record(fault->kind, fault->sample, fault->reason);
    }
  }
};

/// Reports that the budget ended the proof.
void set_ended(Ending ending, Verification& result) {
  result.ending = ending;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  result.deviation.bound = {unknown, unknown};
  if (result.fault != Fault::none) return;
  result.reason =
      ended_by(ending) + " before the whole trajectory was checked" + how_to_continue(ending);
}

/// The trajectory with its joints in the arm's order.
Trajectory checked_trajectory(const Arm& arm, const Trajectory& given) {
  Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  return trajectory;
}

}  // namespace

Verification verify(const Arm& arm, const Trajectory& given, const Route& route,
                    const VerifyOptions& options) {
  if (!(options.tolerance > 0) || !(options.orientation_tolerance > 0)) {
    throw Error("the tolerances must be above zero, not " +
                deviation_text({options.tolerance, options.orientation_tolerance}));
  }
  const Trajectory trajectory = checked_trajectory(arm, given);
  const Task task = options.task.value_or(default_task(arm));
  check_route(arm, route, task);
  BudgetMeter budget(options.budget);
  Verifier verifier{arm,
                    trajectory,
                    route,
                    task,
                    {options.tolerance, options.orientation_tolerance},
                    options.moving,
                    budget};
  for (const Configuration& q : trajectory.positions) {
    if (budget.ended()) break;
    verifier.world_T_tool.push_back(forward_kinematics(arm, q));
  }
  if (budget.complete()) verifier.check_route();
  if (budget.complete()) verifier.check_joints();
  if (!budget.complete()) set_ended(budget.ending(), verifier.result);
  return verifier.result;
}

Verification verify(const Arm& arm, const Trajectory& given, std::span<const Pose> waypoints,
                    const VerifyOptions& options) {
  std::vector<Pose> poses = checked_waypoints(waypoints);
  const Trajectory trajectory = checked_trajectory(arm, given);
  poses.insert(poses.begin(), forward_kinematics(arm, trajectory.positions.front()));
  return verify(arm, trajectory, route_of(lines_through(poses), PathKind::line), options);
}

Verification verify(const Arm& arm, const Trajectory& trajectory,
                    std::initializer_list<Pose> waypoints, const VerifyOptions& options) {
  return verify(arm, trajectory, std::span<const Pose>(waypoints.begin(), waypoints.size()),
                options);
}

std::ostream& operator<<(std::ostream& out, const Verification& verification) {
  if (verification.fault != Fault::none) {
    return out << verification.fault << ": " << verification.reason;
  }
  if (!verification) return out << verification.ending << ": " << verification.reason;
  return out << "verified, deviation at most " << verification.deviation.bound;
}

}  // namespace beeline
