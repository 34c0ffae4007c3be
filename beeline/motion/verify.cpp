#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/verify.h>
#include <beeline/motion/waypoints.h>

namespace beeline {
namespace {

constexpr int looks = 64;  // between two samples, for where the tool is farthest off

std::string metres_and_radians(const Deviation& deviation) {
  return number(deviation.position) + " m and " + angle(deviation.orientation);
}

struct Verifier {
  const Arm& arm;
  const Trajectory& trajectory;
  const std::vector<Pose>& waypoints;
  Task task;
  Deviation tolerance;
  std::vector<Pose> world_T_tool = {};  ///< at the samples
  Verification result = {};

  bool near(const Deviation& deviation) const {
    return deviation.position <= tolerance.position &&
           deviation.orientation <= tolerance.orientation;
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

  Line line(std::size_t w) const {
    return {w == 0 ? world_T_tool.front() : waypoints[w - 1], waypoints[w]};
  }

  /// The sample at which waypoint w is reached: of the first ones in a row that are near it the
  /// nearest; of the last ones where it is the end of the motion, which may pass near it before, as
  /// far as the rows that matter tell. The number of samples where there is none.
  std::size_t arrival(std::size_t w, std::size_t first) const {
    const auto off = [&](std::size_t k) {
      return task_deviation(task, waypoints[w], world_T_tool[k]);
    };
    const std::size_t end = trajectory.size();
    std::size_t k = first;
    if (w + 1 == waypoints.size() && near(off(end - 1))) {
      for (k = end - 1; k > first && near(off(k - 1));) --k;
    }
    std::size_t best = end;
    double least = 0;
    for (; k < end; ++k) {
      const Deviation here = off(k);
      if (!near(here) && best < end) break;
      if (!near(here)) continue;
      const double size =
          std::max(here.position / tolerance.position, here.orientation / tolerance.orientation);
      if (best == end || size < least) best = k, least = size;
    }
    return best;
  }

  /// The step from sample k to the next on line w.
  void check_step(std::size_t k, const Line& on, const Deviation& a, const Deviation& b) {
    const Configuration &q = trajectory.positions[k], &next = trajectory.positions[k + 1];
    const auto [middle, bound] = halved_step(arm, on, task, q, next, a, b);
    Deviation seen = a;
    grow(seen, middle);
    grow(seen, b);
    for (int i = 1; i < looks && !near(bound); ++i) {
      const Pose pose = forward_kinematics(arm, q + i * (next - q) / looks);
      grow(seen, deviation_from(on, pose, task));
    }
    grow(result.straightness.sampled, a);
    grow(result.straightness.sampled, b);
    grow(result.straightness.measured, seen);
    grow(result.straightness.bound, bound);
    if (near(bound)) return;
    const double turn = (next - q).lpNorm<Eigen::Infinity>();
    const std::string jump =
        turn > 0.5 ? "; a joint moves by " + number(turn) + ", as where the branch changes" : "";
    fail(Fault::deviation, k,
         near(seen) ? "up to the next sample the tool is only proved to stay within " +
                          metres_and_radians(bound) + " of the line" + jump
                    : "up to the next sample the tool leaves the line by " +
                          metres_and_radians(seen) + jump);
  }

  /// Samples first to last on line w.
  void check_line(std::size_t w, std::size_t first, std::size_t last) {
    const Line on = line(w);
    Deviation before = deviation_from(on, world_T_tool[first], task);
    for (std::size_t k = first;; ++k) {
      if (!near(before)) {
        fail(Fault::deviation, k,
             "the tool is off line " + std::to_string(w + 1) + " by " + metres_and_radians(before));
        grow(result.straightness.sampled, before);
        grow(result.straightness.measured, before);
        grow(result.straightness.bound, before);
        return;
      }
      if (k == last || result.fault != Fault::none) return;
      const Deviation now = deviation_from(on, world_T_tool[k + 1], task);
      if (near(now)) check_step(k, on, before, now);
      before = now;
    }
  }

  /// Finds the arrivals and checks the lines between them.
  void check_lines() {
    std::size_t first = 0;
    for (std::size_t w = 0; w < waypoints.size() && result.fault == Fault::none; ++w) {
      const std::size_t reached = arrival(w, first);
      const bool missed = reached == trajectory.size();
      const std::size_t last = missed ? trajectory.size() - 1 : reached;
      check_line(w, first, last);
      if (missed) {
        const Deviation left = task_deviation(task, waypoints[w], world_T_tool.back());
        fail(Fault::not_through, last,
             "waypoint " + std::to_string(w + 1) + " is not reached; at the end the tool is " +
                 metres_and_radians(left) + " from it");
        return;
      }
      result.arrivals.push_back(reached);
      first = reached;
    }
    for (std::size_t k = first + 1; k < trajectory.size() && result.fault == Fault::none; ++k) {
      const Line stay{waypoints.back(), waypoints.back()};
      const Deviation off = deviation_from(stay, world_T_tool[k], task);
      if (!near(off)) {
        fail(Fault::deviation, k,
             "the tool moves on from the last waypoint, by " + metres_and_radians(off));
      } else {
        check_step(k - 1, stay, deviation_from(stay, world_T_tool[k - 1], task), off);
      }
    }
  }
};

}  // namespace

Verification verify(const Arm& arm, const Trajectory& given, std::span<const Pose> given_waypoints,
                    const VerifyOptions& options) {
  const std::vector<Pose> waypoints = checked_waypoints(given_waypoints);
  if (!(options.tolerance > 0) || !(options.orientation_tolerance > 0)) {
    throw Error("the tolerances must be above zero, not " + number(options.tolerance) + " m and " +
                number(options.orientation_tolerance) + " rad");
  }
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  const Task task = options.task.value_or(default_task(arm));
  if (task.size() == 0 || task.frame == Frame::space) {
    throw Error("the task needs at least one row, and the base or the tool frame");
  }
  Verifier verifier{
      arm, trajectory, waypoints, task, {options.tolerance, options.orientation_tolerance}};
  for (const Configuration& q : trajectory.positions) {
    verifier.world_T_tool.push_back(forward_kinematics(arm, q));
  }
  verifier.check_lines();
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

}  // namespace beeline
