#include <algorithm>
#include <cmath>
#include <ostream>

#include <beeline/certificate/verify.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_parameter.h>

namespace beeline {
namespace {

constexpr int looks = 64;  // between two samples, for where the tool is farthest off

std::string metres_and_radians(const Deviation& deviation) {
  return number(deviation.position) + " m and " + angle(deviation.orientation);
}

struct Verifier {
  const Arm& arm;
  const Trajectory& trajectory;
  const Route& route;
  Task task;
  Deviation tolerance;
  std::vector<Pose> world_T_tool = {};  ///< at the samples
  Verification result = {};

  bool near(const Deviation& deviation) const { return within(deviation, tolerance); }

  /// All of the segment is near its end.
  bool hardly_moves(const Segment& segment) const {
    const auto there = [&](double s) {
      return near(task_deviation(task, pose_at(segment, s), pose_at(segment, 1)));
    };
    return there(0) && there(0.25) && there(0.5) && there(0.75);
  }

  /// "line 2", "segment 2".
  std::string name_of(std::size_t i) const {
    const bool line = std::holds_alternative<Line>(route.path.segments[i]);
    return (line ? "line " : "segment ") + std::to_string(i + 1);
  }

  void fail(Fault fault, std::size_t k, const std::string& reason) {
    if (result.fault == Fault::none || k < result.sample) tell(fault, k, reason);
  }

  void tell(Fault fault, std::size_t k, const std::string& reason) {
    result.fault = fault;
    result.sample = k;
    result.time = trajectory.times[k];
    result.reason =
        "at " + number(result.time) + " s, sample " + std::to_string(k + 1) + ": " + reason;
  }

  /// The path parameters of the samples from `first` on, up to the one at which the end of the
  /// stretch is reached, or a sample is off its path: of the first ones in a row that are near it
  /// the nearest; of the last ones where it is the end of the motion, which may pass near it
  /// before, as far as the rows that matter tell. All the others', and `reached` false, where there
  /// is none.
  std::vector<double> path_parameters_from(std::size_t first, double begin, std::size_t segment,
                                           bool& reached) const {
    const auto end = static_cast<double>(segment + 1);
    const bool last = segment + 1 == route.path.segments.size();
    const Pose goal = pose_at(route.path.segments[segment], 1);
    const bool line =
        begin == end - 1 && std::holds_alternative<Line>(route.path.segments[segment]);
    double closing = end - 0.5;  // a way may close: its end counts from here on
    for (std::size_t i = segment + 1; i-- > 0 && hardly_moves(route.path.segments[i]);)
      closing -= 1;
    std::vector<double> path_parameters, sizes;  // of the deviation from the goal; -1: not there
    std::size_t next = 0;
    bool met = false;
    for (; first + next < trajectory.size() && (last || !met || sizes.back() >= 0); ++next) {
      const Pose& tool = world_T_tool[first + next];
      const double from = path_parameters.empty() ? begin : path_parameters.back();
      path_parameters.push_back(
          line ? nearest_parameter(route.path, task, tool, from, end)
               : fitting_parameter(route.path, task, tool, from, end, tolerance));
      const Deviation off = task_deviation(task, goal, tool);
      const bool there = near(off) && (line || path_parameters.back() > closing);
      sizes.push_back(there ? std::max(off.position / tolerance.position,
                                       off.orientation / tolerance.orientation)
                            : -1);
      met = met || there;
      if (!line && !near(deviation_from(route.path, path_parameters.back(), tool, task)))
        break;  // a fault
    }
    reached = met;
    if (!met) return path_parameters;
    std::size_t k = 0;
    if (last && sizes.back() >= 0) {
      for (k = sizes.size() - 1; k > 0 && sizes[k - 1] >= 0;) --k;
    }
    while (sizes[k] < 0) ++k;
    std::size_t best = k;
    for (; k < sizes.size() && sizes[k] >= 0; ++k) {
      if (sizes[k] < sizes[best]) best = k;
    }
    path_parameters.resize(best + 1);
    path_parameters.back() = end;
    return path_parameters;
  }

  /// Whether sample k, which is so far off, is near where it should be.
  bool check_sample(std::size_t k, const Deviation& off, const std::string& where) {
    grow(result.deviation.sampled, off);
    if (near(off)) return true;
    grow(result.deviation.measured, off);
    grow(result.deviation.bound, off);
    fail(Fault::deviation, k, "the tool is off " + where + " by " + metres_and_radians(off));
    return false;
  }

  bool check_sample(std::size_t k, double place) {
    const std::size_t i = segment_at(route.path, place);
    const Deviation off = deviation_from(route.path, place, world_T_tool[k], task);
    if (!check_sample(k, off, name_of(i))) return false;
    const Deviation back = task_deviation(task, pose_at(route.path, place), world_T_tool[k]);
    if (near(back)) return true;  // else it is on the line, but not so far as it has been
    fail(Fault::deviation, k,
         "the tool goes back on " + name_of(i) + " by " + metres_and_radians(back));
    return false;
  }

  /// The step from sample k to the next, or the part of it that is on one segment.
  void check_step(std::size_t k, const ToolPath& path, const SegmentStep& step) {
    const MeasuredStep met = measured(arm, path, task, step);
    Deviation seen = met.begin;
    grow(seen, met.middle);
    grow(seen, met.end);
    for (int i = 1; i < looks && !near(met.bound); ++i) {
      const double share = static_cast<double>(i) / looks;
      const Pose pose = forward_kinematics(arm, step.q_a + share * (step.q_b - step.q_a));
      grow(seen, deviation_from(path.segments[step.segment], std::lerp(step.s_a, step.s_b, share),
                                pose, task));
    }
    grow(result.deviation.measured, seen);
    grow(result.deviation.bound, met.bound);
    if (near(met.bound)) return;
    const double turn =
        (trajectory.positions[k + 1] - trajectory.positions[k]).lpNorm<Eigen::Infinity>();
    const std::string jump =
        turn > 0.5 ? "; a joint moves by " + number(turn) + ", as where the branch changes" : "";
    const std::string way =
        std::holds_alternative<Line>(path.segments[step.segment]) ? "line" : "path";
    fail(Fault::deviation, k,
         near(seen) ? "up to the next sample the tool is only proved to stay within " +
                          metres_and_radians(met.bound) + " of the " + way + jump
                    : "up to the next sample the tool leaves the " + way + " by " +
                          metres_and_radians(seen) + jump);
  }

  /// Samples from `first` on, as many as have path parameters, along the route.
  void check_stretch(std::size_t first, const std::vector<double>& path_parameters) {
    for (std::size_t i = 0; i < path_parameters.size(); ++i) {
      if (!check_sample(first + i, path_parameters[i])) return;
      if (i > 0) result.path_parameters.push_back(path_parameters[i]);
      if (i + 1 == path_parameters.size()) return;
      const std::size_t k = first + i;
      const Deviation next =
          deviation_from(route.path, path_parameters[i + 1], world_T_tool[k + 1], task);
      if (!near(next)) continue;  // told as the sample's own fault
      for (const SegmentStep& step :
           cut_at_segments(route.path, task, trajectory.positions[k], path_parameters[i],
                           trajectory.positions[k + 1], path_parameters[i + 1])) {
        check_step(k, route.path, step);
      }
      if (result.fault != Fault::none) return;
    }
  }

  /// After the route's end the tool stays there.
  void check_rest(std::size_t first) {
    const Pose goal = pose_at(route.path.segments.back(), 1);
    const ToolPath stay = lines_through(std::vector{goal, goal});
    for (std::size_t k = first + 1; k < trajectory.size() && result.fault == Fault::none; ++k) {
      const Deviation off = task_deviation(task, goal, world_T_tool[k]);
      if (!near(off)) {
        fail(Fault::deviation, k,
             "the tool moves on from the last waypoint, by " + metres_and_radians(off));
      } else {
        check_step(k - 1, stay, {0, trajectory.positions[k - 1], trajectory.positions[k], 1, 1});
      }
    }
  }

  /// Finds where the samples are, from stop to stop, and checks the ways between them.
  void follow_route() {
    const std::size_t segments = route.path.segments.size();
    result.path = route.path;
    result.path_parameters = {0};
    std::size_t first = 0, begin = 0;
    check_sample(0, task_deviation(task, pose_at(route.path, 0), world_T_tool[0]),
                 "the path's begin");
    for (std::size_t i = 0; i < segments && result.fault == Fault::none; ++i) {
      if (i + 1 < segments && !route.stops[i]) continue;
      bool reached = false;
      const std::vector<double> path_parameters =
          path_parameters_from(first, static_cast<double>(begin), i, reached);
      check_stretch(first, path_parameters);
      if (!reached) {
        const Deviation left =
            task_deviation(task, pose_at(route.path.segments[i], 1), world_T_tool.back());
        const bool line = std::holds_alternative<Line>(route.path.segments[i]);
        fail(Fault::not_through, trajectory.size() - 1,
             (line ? "waypoint " : "the end of segment ") + std::to_string(i + 1) +
                 " is not reached; at the end the tool is " + metres_and_radians(left) +
                 " from it");
        break;
      }
      if (result.fault == Fault::none) result.path_parameters.back() = path_parameters.back();
      first += path_parameters.size() - 1;
      begin = i + 1;
    }
    if (result.fault == Fault::none) check_rest(first);
    result.arrivals = beeline::arrivals(result.path_parameters);
  }
};

}  // namespace

Verification verify(const Arm& arm, const Trajectory& given, const Route& route,
                    const VerifyOptions& options) {
  if (!(options.tolerance > 0) || !(options.orientation_tolerance > 0)) {
    throw Error("the tolerances must be above zero, not " + number(options.tolerance) + " m and " +
                number(options.orientation_tolerance) + " rad");
  }
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  const Task task = options.task.value_or(default_task(arm));
  check_route(arm, route, task);
  Verifier verifier{
      arm, trajectory, route, task, {options.tolerance, options.orientation_tolerance}};
  for (const Configuration& q : trajectory.positions) {
    verifier.world_T_tool.push_back(forward_kinematics(arm, q));
  }
  verifier.follow_route();
  constexpr std::size_t stencil = 3;  // samples by which a jerk is told before its cause
  const auto fault = first_joint_fault(arm, trajectory);
  if (fault) {
    const bool leap = fault->kind == Fault::limits || fault->kind == Fault::flip;
    const Verification& seen = verifier.result;
    if (seen.fault == Fault::none || fault->sample + (leap ? 0 : stencil + 1) <= seen.sample) {
      verifier.tell(fault->kind, fault->sample, fault->reason);
    }
  }
  return verifier.result;
}

Verification verify(const Arm& arm, const Trajectory& given, std::span<const Pose> waypoints,
                    const VerifyOptions& options) {
  std::vector<Pose> poses = checked_waypoints(waypoints);
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  poses.insert(poses.begin(), forward_kinematics(arm, trajectory.positions.front()));
  return verify(arm, trajectory, route_of(lines_through(poses), PathKind::line), options);
}

std::ostream& operator<<(std::ostream& out, const Verification& verification) {
  if (verification.fault != Fault::none) {
    return out << name(verification.fault) << ": " << verification.reason;
  }
  return out << "verified, deviation at most " << verification.deviation.bound;
}

}  // namespace beeline
