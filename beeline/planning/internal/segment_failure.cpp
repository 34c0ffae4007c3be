#include <algorithm>

#include <beeline/internal/rounded_number.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/internal/segment_failure.h>

namespace beeline::internal {
namespace {

constexpr double regular_condition = 1e3;  // above it the arm counts as near a singularity
constexpr double same_branch = 0.2;        // radians or metres: farther away is another branch

/// Returns a phrase that lists the joints outside their limits at q; empty when there are none.
std::string joints_outside(const Arm& arm, const Configuration& q) {
  std::string text;
  for (const int k : outside_limits(arm, q, 0)) {
    text += (text.empty() ? "" : ", and ") + limit_message(arm, k, q[k] < arm.limits(k).lower);
  }
  return text;
}

/// Returns the limits that the motion would pass if it continued without limits; empty if it cannot
/// continue so for at least 1e-4 of the segment.
std::string passed_limits(const Arm& arm, const Segment& segment, const Task& task,
                          const Configuration& q, double s) {
  constexpr double continued = 1e-4;
  std::string joints;
  for (const double ahead : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const Pose next = pose_at(segment, std::min(1.0, s + ahead));
    const NumericalResult free = levenberg_marquardt(arm, next, task, no_bounds(arm), q);
    if (!free.converged || (free.q - q).lpNorm<Eigen::Infinity>() > same_branch) return {};
    if (joints.empty()) joints = joints_outside(arm, free.q);
    if (!joints.empty() && ahead >= continued) return joints;
  }
  return {};
}

/// Solves inverse kinematics for the pose ahead. Just outside the workspace it may not prove that
/// no solution exists; then poses farther ahead are tried.
InverseResult solve_ahead(const Arm& arm, const Segment& segment, const Task& task,
                          const Configuration& q, double s, const Budget& budget) {
  InverseResult answer;
  for (const double ahead : {1e-3, 1e-2, 1e-1}) {
    const Pose next = pose_at(segment, std::min(1.0, s + ahead));
    InverseResult result =
        inverse_kinematics(arm, next, {.seed = q, .task = task, .budget = budget});
    const bool proved = result.status == InverseStatus::unreachable ||
                        result.status == InverseStatus::orientation_unreachable;
    if (answer.reason.empty() || proved) answer = std::move(result);
    if (answer.status != InverseStatus::not_found) break;
  }
  return answer;
}

}  // namespace

std::string stop_message(const Segment& segment, double s) {
  const Vector3 p = pose_at(segment, s).translation();
  const bool line = std::holds_alternative<Line>(segment);
  return "stops after " + percent(s) + (line ? " of its length, at x " : " of it, at x ") +
         number(p.x()) + ", y " + number(p.y()) + ", z " + number(p.z()) + " m: ";
}

std::string limit_message(const Arm& arm, int coordinate, bool lower) {
  const Limits& limits = arm.limits(coordinate);
  const Joint& joint = arm.joint_of(coordinate);
  return "joint " + joint.name + " would have to pass its " + (lower ? "lower" : "upper") +
         " limit of " + with_unit(joint, lower ? limits.lower : limits.upper);
}

SegmentFailure segment_failure(const Arm& arm, const Segment& segment, const Task& task,
                               const Configuration& q, double s, const Budget& budget) {
  const std::string where = stop_message(segment, s);
  const std::string joints = passed_limits(arm, segment, task, q, s);
  if (!joints.empty()) return {MotionStatus::outside_limits, where + joints};
  const InverseResult ahead = solve_ahead(arm, segment, task, q, s, budget);
  const double condition = manipulability_measures(task_jacobian(arm, q, task)).condition;
  switch (ahead.status) {
    case InverseStatus::solved:
      if (condition < regular_condition) {
        return {MotionStatus::not_proved,
                where + "no step is proved to keep the tolerance; allow a larger one"};
      }
      return {MotionStatus::singular,
              where +
                  "the arm is singular there; it could continue only by jumping to another branch, "
                  "such as another elbow"};
    case InverseStatus::outside_limits:
      return {MotionStatus::outside_limits, where + ahead.reason};
    case InverseStatus::unreachable:
      return {MotionStatus::unreachable,
              where + "the path leaves the arm's workspace; " + ahead.reason};
    case InverseStatus::orientation_unreachable:
      return {MotionStatus::unreachable, where + ahead.reason};
    case InverseStatus::time_limit:
    case InverseStatus::cancelled:
    case InverseStatus::work_limit:
      return {motion_status(ahead.status), where + ahead.reason};
    case InverseStatus::not_found:
      break;
  }
  const std::string near_singular =
      condition < regular_condition
          ? ""
          : ", and the arm is singular there, as at the edge of its workspace";
  return {MotionStatus::not_found, where + "no configuration was found to continue with" +
                                       near_singular + "; " + ahead.reason};
}

SegmentFailure too_many_samples(std::size_t max_samples) {
  return {MotionStatus::too_many_samples, "needs more than " + std::to_string(max_samples) +
                                              " samples in all; allow a larger tolerance or "
                                              "more samples"};
}

}  // namespace beeline::internal
