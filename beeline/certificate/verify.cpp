#include <algorithm>
#include <cmath>
#include <ostream>

#include <beeline/certificate/internal/fault_list.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_interval.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/certificate/internal/printed_bound.h>
#include <beeline/certificate/internal/sample_locator.h>
#include <beeline/certificate/internal/segment_taylor_bound.h>
#include <beeline/certificate/internal/set_fault.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline {

using namespace internal;

namespace {

struct Verifier {
  const Arm& arm;
  const Trajectory& trajectory;
  const Route& route;
  const VerifyOptions& options;
  BudgetMeter& budget;
  Task task = options.task.value_or(default_task(arm));
  Deviation tolerance = {options.tolerance, options.orientation_tolerance};
  std::vector<Pose> world_T_tool = {};  ///< at the samples
  Verification result = {};
  /// The largest segment parameter up to the current interval. On a line by position it is an upper
  /// bound on the parameter of the tool's projection, on other segments on s(u).
  struct {
    std::size_t segment = 0;
    double s = 0;
  } furthest = {};

  bool near(const Deviation& deviation) const { return within(deviation, tolerance); }

  bool is_line(std::size_t i) const { return std::holds_alternative<Line>(route.path.segments[i]); }

  std::string name_of(std::size_t i) const { return segment_name(route.path, i); }

  /// Records a fault, unless an earlier one is recorded.
  void fail(Fault fault, std::size_t k, Reason reason) {
    if (result.fault == Fault::none || k < result.sample) record(fault, k, std::move(reason));
  }

  void record(Fault fault, std::size_t k, Reason reason) {
    set_fault(trajectory, fault, k, std::move(reason), result);
  }

  static Reason away(ReasonCode code, const Deviation& deviation, std::string segment_name) {
    return deviation_reason(code, deviation)
        .set(ReasonField::segment_name, std::move(segment_name));
  }

  /// Returns whether sample k, with this deviation, is within tolerance; records a fault if not.
  bool check_sample(std::size_t k, const Deviation& deviation, const std::string& where) {
    grow(result.deviation.sampled, deviation);
    if (near(deviation)) return true;
    grow(result.deviation.measured, deviation);
    grow(result.deviation.bound, deviation);
    fail(Fault::deviation, k, away(ReasonCode::off_path, deviation, where));
    return false;
  }

  bool check_sample(std::size_t k, double s) {
    const std::size_t i = segment_at(route.path, s);
    const Deviation deviation = deviation_from(route.path, s, world_T_tool[k], task);
    if (!check_sample(k, deviation, name_of(i))) return false;
    // Path parameters do not decrease, but the nearest point of a line may lie before s.
    const Deviation back = task_deviation(task, pose_at(route.path, s), world_T_tool[k]);
    if (near(back)) return true;
    fail(Fault::backwards, k, away(ReasonCode::moves_backwards, back, name_of(i)));
    return false;
  }

  /// Checks the motion from sample k to the next, or the part that is on one segment.
  void check_interval(std::size_t k, const ToolPath& path, const PathInterval& part) {
    constexpr int probes = 64;  // times in an interval that fails, to find its largest deviation
    const Segment& segment = path.segments[part.segment];
    auto [measured, bound, projections] =
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
    grow(result.deviation.interval_bounds[k], bound);
    if (!near(bound))
      return fail_between(k, std::holds_alternative<Line>(segment), measured, bound);
    check_direction(k, segment, part, projections);
  }

  /// Records that the deviation after sample k is not proved to be within tolerance.
  void fail_between(std::size_t k, bool line, const Deviation& measured, const Deviation& bound) {
    const double change =
        (trajectory.positions[k + 1] - trajectory.positions[k]).lpNorm<Eigen::Infinity>();
    Reason reason = near(measured) ? deviation_reason(ReasonCode::deviation_unproved, bound)
                                   : deviation_reason(ReasonCode::leaves_path, measured);
    reason.set(ReasonField::is_line, line);
    if (change > 0.5) reason.set(ReasonField::change, change);
    fail(Fault::deviation, k, std::move(reason));
  }

  /// Records a fault if the tool may move backwards on the segment by more than the tolerance,
  /// which false velocities cause.
  void check_direction(std::size_t k, const Segment& segment, const PathInterval& part,
                       const std::vector<LineProjection>& projections) {
    if (part.segment != furthest.segment) furthest = {part.segment};
    const Deviation moved = projections.empty()
                                ? parameter_decrease(segment, part.interval.s)
                                : projection_decrease(std::get<Line>(segment), projections);
    if (near(moved)) return;
    fail(Fault::backwards, k, away(ReasonCode::may_move_backwards, moved, name_of(part.segment)));
  }

  /// Bounds the change of the segment's pose from the largest value of s(u) so far to a later,
  /// smaller value.
  Deviation parameter_decrease(const Segment& segment, const Polynomial& s) {
    const double back = largest_decrease(s, furthest.s);
    const Extremes range = extremes(s);
    const double largest = std::max(range.largest, furthest.s);
    furthest.s = largest;
    if (!(back > 0)) return {};
    const SegmentTaylorBound rates = segment_taylor_bound(
        segment, std::clamp(range.smallest, 0.0, 1.0), std::clamp(largest, 0.0, 1.0));
    return {task.positions() > 0 ? back * rates.position.c[1] : 0,
            task.orientations() > 0 ? back * rates.rotation.c[1] : 0};
  }

  /// Bounds the same change for the tool's projection on a line. With s its polynomial, the
  /// projection is within s +- error, so it decreases by at most 2 errors more than s does.
  Deviation projection_decrease(const Line& line, const std::vector<LineProjection>& projections) {
    double back = 0;
    for (const LineProjection& part : projections) {
      back = std::max(back, largest_decrease(part.s, furthest.s) + 2 * part.error);
      furthest.s = std::max(furthest.s, extremes(part.s).largest + part.error);
    }
    const LineExtent extent = extent_of(line, task);
    return {back * extent.length, back * extent.angle};
  }

  /// Checks the samples from `first` on that have path parameters, and the steps between them.
  void check_samples(std::size_t first, const std::vector<double>& path_parameters) {
    for (std::size_t i = 0; i < path_parameters.size(); ++i) {
      if (!check_sample(first + i, path_parameters[i])) return;
      if (i > 0) result.path_parameters.push_back(path_parameters[i]);
      if (i + 1 == path_parameters.size() || budget.ended()) return;
      const std::size_t k = first + i;
      const Deviation next =
          deviation_from(route.path, path_parameters[i + 1], world_T_tool[k + 1], task);
      if (!near(next)) continue;  // the next sample has this fault
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
        fail(Fault::deviation, k, deviation_reason(ReasonCode::leaves_last_waypoint, left));
      }
    }
  }

  void fail_to_reach(std::size_t i) {
    const Deviation left =
        task_deviation(task, pose_at(route.path.segments[i], 1), world_T_tool.back());
    fail(Fault::not_through, trajectory.size() - 1,
         away(ReasonCode::waypoint_not_reached, left, segment_end_name(route.path, i)));
  }

  /// Checks that no joint but those that return to their limits moves before sample `first`, where
  /// the tool is on the path.
  void check_recovery(std::size_t first) {
    const Configuration& start = trajectory.positions.front();
    for (std::size_t k = 0; k < first && result.fault == Fault::none; ++k) {
      if (budget.ended(arm.dof())) return;
      for (int i = 0; i < arm.dof(); ++i) {
        if (excess_over(arm.limits(i), start[i]) > position_slack) continue;
        const Extremes q = extremes(interval_polynomial(trajectory, k, i));
        if (std::max(q.largest - start[i], start[i] - q.smallest) <= position_slack) continue;
        const Deviation off = task_deviation(task, pose_at(route.path, 0), world_T_tool[k + 1]);
        return fail(Fault::deviation, k + 1,
                    away(ReasonCode::off_path, off, "the path's beginning"));
      }
    }
  }

  /// Locates and checks all samples, from stop to stop.
  void prove_route() {
    const std::size_t segments = route.path.segments.size();
    result.deviation.interval_bounds.resize(trajectory.size() - 1);
    result.path = route.path;
    std::size_t first = begin_of_path(result.recovery), begin = 0;
    result.path_parameters.assign(first + 1, 0);
    std::fill_n(result.deviation.interval_bounds.begin(), first, no_bound);
    check_recovery(first);
    check_sample(first, task_deviation(task, pose_at(route.path, 0), world_T_tool[first]),
                 "the path's beginning");
    for (std::size_t i = 0; i < segments && result.fault == Fault::none; ++i) {
      if (i + 1 < segments && !route.stops[i]) continue;
      const SampleParameters found =
          SampleLocator(arm, trajectory, route, task, tolerance, world_T_tool, budget)
              .from(first, begin, i);
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

  /// Checks the joints. A joint fault replaces a deviation at the same time or later.
  void check_joints() {
    constexpr std::size_t stencil = 3;  // samples by which a difference may precede its cause
    const std::vector<FaultsOfKind> of_path = path_faults();
    const auto fault = first_joint_fault(arm, trajectory, options.moving, budget.part(),
                                         options.limit_tolerance, options.recover);
    if (fault) {
      const bool position = fault->kind == Fault::limits || fault->kind == Fault::flip;
      if (result.fault == Fault::none ||
          fault->sample + (position ? 0 : stencil + 1) <= result.sample) {
        record(fault->kind, fault->sample, fault->reason);
      }
    }
    list_faults(arm, trajectory, options, of_path, budget, result);
  }

  /// Returns the fault of the path and, of deviations, the largest of a sample from there on.
  std::vector<FaultsOfKind> path_faults() {
    std::vector<FaultsOfKind> list;
    if (result.fault == Fault::none) return list;
    const bool off = result.fault == Fault::deviation;
    add_fault(trajectory, result.fault, result.sample,
              off ? multiple(result.deviation.measured) : 0, result.reason, list);
    if (!off || !all_lines(route.path)) return list;
    std::size_t worst = result.sample;
    Deviation largest = {};
    constexpr std::size_t most = 1'000'000;  // pairs of a sample and a line, a fraction of a second
    const std::size_t segments = route.path.segments.size();
    const std::size_t stride = 1 + (trajectory.size() - result.sample) * segments / most;
    for (std::size_t k = result.sample; k < trajectory.size(); k += stride) {
      if (budget.ended(static_cast<std::int64_t>(segments))) return list;
      const Deviation distance = distance_from_lines(world_T_tool[k], multiple(largest));
      if (multiple(distance) <= multiple(largest)) continue;
      largest = distance;
      worst = k;
    }
    add_fault(trajectory, Fault::deviation, worst, multiple(largest),
              away(ReasonCode::off_path, largest, "the path"), list);
    return list;
  }

  double multiple(const Deviation& deviation) const {
    return std::max(deviation.position / tolerance.position,
                    deviation.orientation / tolerance.orientation);
  }

  /// Returns the deviation from the nearest of the route's lines. The search ends at a line that is
  /// nearer than `least` multiples of the tolerance.
  Deviation distance_from_lines(const Pose& pose, double least) const {
    Deviation nearest = deviation_from(route.path.segments.front(), 0, pose, task);
    for (const Segment& segment : route.path.segments) {
      const Deviation distance = deviation_from(segment, 0, pose, task);
      if (multiple(distance) < multiple(nearest)) nearest = distance;
      if (multiple(nearest) <= least) break;
    }
    return nearest;
  }
};

/// Reports that the budget ended the proof.
void set_ended(Ending ending, Verification& result) {
  result.ending = ending;
  if (result.fault != Fault::none) return;
  result.reason = ended_reason(ReasonCode::ended_before_check, ending);
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
  check_limit_tolerance(options.limit_tolerance);
  const Trajectory trajectory = checked_trajectory(arm, given);
  BudgetMeter budget(options.budget);
  Verifier verifier{arm, trajectory, route, options, budget};
  verifier.result.deviation.bound = {};
  verifier.result.recovery = accepted_recovery(arm, trajectory, options.recover);
  check_route(arm, route, verifier.task);
  check_in_plane(arm, route.path, options.task);
  for (const Configuration& q : trajectory.positions) {
    if (budget.ended()) break;
    verifier.world_T_tool.push_back(forward_kinematics(arm, q));
  }
  if (budget.complete()) verifier.prove_route();
  if (budget.complete()) verifier.check_joints();
  if (!budget.complete()) set_ended(budget.ending(), verifier.result);
  if (!verifier.result) verifier.result.deviation.bound = no_bound;
  return verifier.result;
}

Verification verify(const Arm& arm, const Trajectory& given, std::span<const Pose> waypoints,
                    const VerifyOptions& options) {
  std::vector<Pose> poses = checked_waypoints(waypoints);
  const Trajectory trajectory = checked_trajectory(arm, given);
  const std::optional<Recovery> recovery = accepted_recovery(arm, trajectory, options.recover);
  const Configuration& begin = trajectory.positions[begin_of_path(recovery)];
  poses.insert(poses.begin(), forward_kinematics(arm, begin));
  return verify(arm, trajectory, route_of(lines_through(poses), PathKind::line), options);
}

Verification verify(const Arm& arm, const Trajectory& trajectory,
                    std::initializer_list<Pose> waypoints, const VerifyOptions& options) {
  return verify(arm, trajectory, std::span<const Pose>(waypoints.begin(), waypoints.size()),
                options);
}

Verification verify(const Arm& arm, const Trajectory& given, const VerifyOptions& options) {
  check_limit_tolerance(options.limit_tolerance);
  const Trajectory trajectory = checked_trajectory(arm, given);
  BudgetMeter budget(options.budget);
  Verification result;
  result.recovery = accepted_recovery(arm, trajectory, options.recover);
  const auto fault = first_joint_fault(arm, trajectory, options.moving, budget.part(),
                                       options.limit_tolerance, options.recover);
  if (fault) set_fault(trajectory, fault->kind, fault->sample, fault->reason, result);
  list_faults(arm, trajectory, options, {}, budget, result);
  if (!budget.complete()) set_ended(budget.ending(), result);
  return result;
}

std::ostream& operator<<(std::ostream& out, const Verification& verification) {
  if (verification.fault != Fault::none) {
    return out << verification.fault << ": " << verification.reason;
  }
  if (!verification) return out << verification.ending << ": " << verification.reason;
  if (verification.path.segments.empty()) return out << "verified, limits of the joints only";
  return print_bound(out << "verified, ", verification.deviation.bound);
}

}  // namespace beeline
