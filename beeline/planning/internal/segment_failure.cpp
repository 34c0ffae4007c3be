#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/segment_failure.h>
#include <beeline/planning/internal/singular_joint.h>

namespace beeline::internal {
namespace {

constexpr double regular_condition = 1e3;  // above it the arm counts as near a singularity
constexpr double same_branch = 0.2;        // radians or metres: farther away is another branch

/// The end of the tracked part of a segment: configuration q at its fraction s.
struct TrackedEnd {
  const Arm& arm;
  const Segment& segment;
  const Task& task;
  const Configuration& q;
  double s;
  const Budget& budget;

  /// The fraction of the segment that is `distance` ahead, in units of the arm's size or of the
  /// segment, whichever is shorter.
  double ahead(double distance) const {
    const double longest = std::min(1.0, 1 / weighted_length(arm, segment));
    return std::min(1.0, s + distance * longest);
  }
};

/// The joints outside their limits at q: the first, the others as its details.
Reason joints_outside(const Arm& arm, const Configuration& q) {
  Reason reason;
  for (const int k : outside_limits(arm, q, 0)) {
    Reason passed = passed_limit(arm, k, q[k] < arm.limits(k).lower);
    if (reason) {
      reason.details.push_back(std::move(passed));
    } else {
      reason = std::move(passed);
    }
  }
  return reason;
}

/// Returns the limits that the motion would pass if it continued without limits; none if it cannot
/// continue so for at least 1e-4 of the segment, or of the arm's size.
Reason passed_limits(const TrackedEnd& end) {
  constexpr double continued = 1e-4;
  Reason joints;
  for (const double distance : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const Pose next = pose_at(end.segment, end.ahead(distance));
    const NumericalResult free =
        levenberg_marquardt(end.arm, next, end.task, no_bounds(end.arm), end.q);
    if (!free.converged || (free.q - end.q).lpNorm<Eigen::Infinity>() > same_branch) return {};
    if (!joints) joints = joints_outside(end.arm, free.q);
    if (joints && distance >= continued) return joints;
  }
  return {};
}

/// The answer of inverse kinematics for the pose at the fraction s of a segment.
struct Probe {
  double s = 1;
  InverseResult answer;
};

bool is_unreachable(const InverseResult& answer) {
  return answer.status == InverseStatus::unreachable ||
         answer.status == InverseStatus::orientation_unreachable;
}

Probe probe(const TrackedEnd& end, double s) {
  return {
      s,
      inverse_kinematics(
          end.arm, pose_at(end.segment, s),
          {.seed = end.q, .task = end.task, .redundancy = Redundancy::any, .budget = end.budget})};
}

/// Solves inverse kinematics for the pose ahead. Just outside the workspace it may not prove that
/// no solution exists; then poses farther ahead are tried. Next to a singularity it may miss the
/// solution by rounding; then one that is found farther ahead counts.
Probe solve_ahead(const TrackedEnd& end, bool singular) {
  std::optional<Probe> found;
  for (const double distance : {1e-3, 1e-2, 1e-1}) {
    Probe next = probe(end, end.ahead(distance));
    const bool solved = singular && next.answer.status == InverseStatus::solved;
    if (!found || solved || is_unreachable(next.answer)) found = std::move(next);
    if (found->answer.status != InverseStatus::not_found) break;
  }
  return *found;
}

/// Returns the reason of inverse kinematics with its pose.
Reason reason_at(const TrackedEnd& stop, const Probe& probe) {
  InverseResult answer = probe.answer;
  explain(answer, stop.budget);
  Reason reason = answer.reason;
  reason.set(ReasonField::fraction, probe.s);
  reason.set(ReasonField::position, Vector3(pose_at(stop.segment, probe.s).translation()));
  return reason;
}

/// Returns the reason why the pose ahead cannot be reached. If the segment's end cannot be reached
/// for the same reason, the reason has the amount at the end, which does not depend on the distance
/// of the pose ahead. If the end cannot be reached for the other reason, each amount has its own
/// pose.
Reason unreachable_ahead(const TrackedEnd& stop, const Probe& ahead, const Probe& end) {
  const bool by_position = ahead.answer.status == InverseStatus::unreachable;
  const bool same_at_end = end.answer.status == ahead.answer.status;
  Reason reason{by_position ? ReasonCode::path_leaves_workspace
                            : ReasonCode::path_loses_orientation};
  reason.details = {reason_at(stop, same_at_end ? end : ahead)};
  if (!same_at_end && is_unreachable(end.answer)) {
    reason.details.push_back(reason_at(stop, end));
  }
  return reason;
}

/// Why the arm is singular: at the segment's beginning, up to a thousandth of the arm's size, with
/// the joint.
Reason singular_reason(const TrackedEnd& end) {
  constexpr double nearby = 1e-3;
  if (end.s * weighted_length(end.arm, end.segment) > nearby) {
    return {ReasonCode::singular_on_path};
  }
  Reason reason{ReasonCode::singular_at_start};
  if (const std::optional<int> k =
          singular_joint(end.arm, independent_rows(end.arm, end.task), end.q)) {
    set_joint(end.arm.joint_of(*k), reason).set(ReasonField::value, end.q[*k]);
  }
  return reason;
}

/// The largest distance of a coordinate from q to the nearest configuration for the pose at the
/// fraction s; infinite where none is found.
double nearest_distance(const TrackedEnd& end, double s) {
  const InverseResult answer = inverse_kinematics(
      end.arm, pose_at(end.segment, s),
      {.seed = end.q, .task = end.task, .redundancy = Redundancy::nearest, .budget = end.budget});
  if (answer.status != InverseStatus::solved) return Limits::none;
  return (answer.solutions.front() - end.q).lpNorm<Eigen::Infinity>();
}

/// Whether a configuration continues q without a jump. Its distance from q then vanishes with the
/// distance along the segment, as its square root if two branches meet, as at a stretched elbow.
/// Behind a jump the distance hardly changes.
bool continues(const TrackedEnd& end) {
  constexpr double shortest = 1e-7, longer = 1e-5;  // the square roots have the ratio 0.1
  constexpr double vanishing = 0.3;
  const auto distance = [&](double ahead) { return nearest_distance(end, end.ahead(ahead)); };
  const double far = distance(longer);
  return far <= same_branch && distance(shortest) <= vanishing * far;
}

/// The status and reason by inverse kinematics for the poses ahead, with or without solutions.
SegmentFailure failure_ahead(const TrackedEnd& end) {
  const Task rows = independent_rows(end.arm, end.task);
  const bool singular =
      rows.size() > 0 &&
      !(manipulability_measures(task_jacobian(end.arm, end.q, rows)).condition < regular_condition);
  const Probe ahead = solve_ahead(end, singular);
  switch (ahead.answer.status) {
    case InverseStatus::solved:
      if (!singular || continues(end)) {
        return {MotionStatus::not_proved,
                {ReasonCode::step_not_proved, {{ReasonField::near_singular, singular}}}};
      }
      return {MotionStatus::singular, singular_reason(end)};
    case InverseStatus::outside_limits:
      return {MotionStatus::outside_limits,
              {ReasonCode::pose_outside_limits, {}, {reason_at(end, ahead)}}};
    case InverseStatus::unreachable:
    case InverseStatus::orientation_unreachable:
      return {MotionStatus::unreachable, unreachable_ahead(end, ahead, probe(end, 1))};
    case InverseStatus::time_limit:
    case InverseStatus::cancelled:
    case InverseStatus::work_limit:
      return {motion_status(ahead.answer.status),
              {ReasonCode::ended_at_pose, {}, {ahead.answer.reason}}};
    case InverseStatus::not_found:
    case InverseStatus::blocked:  // only with InverseOptions::blocked_by
      break;
  }
  return {MotionStatus::not_found,
          {ReasonCode::no_configuration_found,
           {{ReasonField::near_singular, singular}},
           {reason_at(end, ahead)}}};
}

}  // namespace

void set_stop(const Segment& segment, double s, Reason& reason) {
  reason.set(ReasonField::is_line, std::holds_alternative<Line>(segment));
  reason.set(ReasonField::fraction, s);
  reason.set(ReasonField::position, Vector3(pose_at(segment, s).translation()));
}

Reason passed_limit(const Arm& arm, int coordinate, bool lower) {
  const Limits& limits = arm.limits(coordinate);
  Reason reason = joint_reason(ReasonCode::would_pass_limits, arm.joint_of(coordinate));
  reason.set(ReasonField::is_upper, !lower);
  return reason.set(ReasonField::limit, lower ? limits.lower : limits.upper);
}

SegmentFailure segment_failure(const Arm& arm, const Segment& segment, const Task& task,
                               const Configuration& q, double s, const Budget& budget) {
  const TrackedEnd end{arm, segment, task, q, s, budget};
  SegmentFailure failure{MotionStatus::outside_limits, passed_limits(end)};
  if (!failure.reason) failure = failure_ahead(end);
  set_stop(segment, s, failure.reason);
  return failure;
}

SegmentFailure too_many_samples(std::size_t max_samples) {
  return {MotionStatus::too_many_samples,
          {ReasonCode::too_many_samples, {{ReasonField::max_samples, max_samples}}}};
}

}  // namespace beeline::internal
