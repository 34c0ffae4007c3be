#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/internal/rounded_number.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/internal/knot_sequence.h>
#include <beeline/planning/internal/segment_failure.h>
#include <beeline/planning/internal/singular_joint.h>

namespace beeline::internal {
namespace {

constexpr double regular_condition = 1e3;  // above it the arm counts as near a singularity
constexpr double same_branch = 0.2;        // radians or metres: farther away is another branch

/// The part of a segment as long as the arm's size, as a fraction; 1 where the segment is shorter.
/// Poses ahead are sought within it.
double longest_probed(const Arm& arm, const Segment& segment) {
  return std::min(1.0, unit_of_length(arm) / weighted_length(segment));
}

/// Returns a phrase that lists the joints outside their limits at q; empty when there are none.
std::string joints_outside(const Arm& arm, const Configuration& q) {
  std::string text;
  for (const int k : outside_limits(arm, q, 0)) {
    text += (text.empty() ? "" : ", and ") + limit_message(arm, k, q[k] < arm.limits(k).lower);
  }
  return text;
}

/// Returns the limits that the motion would pass if it continued without limits; empty if it cannot
/// continue so for at least 1e-4 of the segment, or of the arm's size.
std::string passed_limits(const Arm& arm, const Segment& segment, const Task& task,
                          const Configuration& q, double s) {
  constexpr double continued = 1e-4;
  const double unit = longest_probed(arm, segment);
  std::string joints;
  for (const double ahead : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const Pose next = pose_at(segment, std::min(1.0, s + ahead * unit));
    const NumericalResult free = levenberg_marquardt(arm, next, task, no_bounds(arm), q);
    if (!free.converged || (free.q - q).lpNorm<Eigen::Infinity>() > same_branch) return {};
    if (joints.empty()) joints = joints_outside(arm, free.q);
    if (!joints.empty() && ahead >= continued) return joints;
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

Probe probe(const Arm& arm, const Segment& segment, const Task& task, const Configuration& q,
            double s, const Budget& budget) {
  return {
      s, inverse_kinematics(arm, pose_at(segment, s), {.seed = q, .task = task, .budget = budget})};
}

/// Solves inverse kinematics for the pose ahead. Just outside the workspace it may not prove that
/// no solution exists; then poses farther ahead are tried. Next to a singularity it may miss the
/// solution by rounding; then one that is found farther ahead counts.
Probe solve_ahead(const Arm& arm, const Segment& segment, const Task& task, const Configuration& q,
                  double s, bool singular, const Budget& budget) {
  const double unit = longest_probed(arm, segment);
  std::optional<Probe> found;
  for (const double ahead : {1e-3, 1e-2, 1e-1}) {
    Probe next = probe(arm, segment, task, q, std::min(1.0, s + ahead * unit), budget);
    const bool solved = singular && next.answer.status == InverseStatus::solved;
    if (!found || solved || is_unreachable(next.answer)) found = std::move(next);
    if (found->answer.status != InverseStatus::not_found) break;
  }
  return *found;
}

/// "x 0.1, y 0.2, z 0.3 m", the position at the fraction s of the segment.
std::string position_text(const Segment& segment, double s) {
  constexpr double rounding = 1e-12;  // metres
  const Vector3 p = pose_at(segment, s).translation();
  const auto text = [](double x) { return number(std::abs(x) < rounding ? 0 : x); };
  return "x " + text(p.x()) + ", y " + text(p.y()) + ", z " + text(p.z()) + " m";
}

/// The reason of inverse kinematics, with the pose to which it belongs.
std::string reason_at(const Segment& segment, const Probe& probe) {
  return (probe.s == 1 ? "at its end" : "after " + number(100 * probe.s) + " %") + ", at " +
         position_text(segment, probe.s) + ", " + probe.answer.reason;
}

/// Why the pose ahead cannot be reached. If the segment's end cannot be reached for the same
/// reason, the amount is that at the end, as it does not depend on how far ahead the search looked;
/// if for the other one, each amount stands with its pose.
std::string unreachable_text(const Segment& segment, const Probe& ahead, const Probe& end) {
  const bool by_position = ahead.answer.status == InverseStatus::unreachable;
  const bool same_at_end = end.answer.status == ahead.answer.status;
  const bool other_at_end = !same_at_end && is_unreachable(end.answer);
  const bool rotations_help = !by_position && !other_at_end;
  return std::string(by_position ? "the path leaves the arm's workspace; "
                                 : "the arm cannot keep the path's orientation; ") +
         reason_at(segment, same_at_end ? end : ahead) +
         (other_at_end ? "; " + reason_at(segment, end) : "") +
         "; a larger tolerance does not help" +
         (rotations_help ? ", a task that leaves rotations free may" : "");
}

/// Whether the fraction s of the segment is its beginning, up to a thousandth of the arm's size.
bool is_beginning(const Arm& arm, const Segment& segment, double s) {
  constexpr double nearby = 1e-3;
  return s * weighted_length(segment) <= nearby * unit_of_length(arm);
}

/// Why a segment cannot begin with a configuration at which the arm is singular.
std::string singular_start_text(const Arm& arm, const Task& task, const Configuration& q) {
  const std::optional<int> k = singular_joint(arm, task, q);
  const std::string direction =
      "so the tool can leave it in this direction only with a jump of the joints";
  if (!k) return "the arm is singular at this start, " + direction;
  const Joint& joint = arm.joint_of(*k);
  return "the arm is singular at this start, with joint " + joint.name + " at " +
         with_unit(joint, q[*k]) + ", " + direction +
         "; with another value of this joint it is not singular";
}

}  // namespace

std::string stop_message(const Segment& segment, double s) {
  const bool line = std::holds_alternative<Line>(segment);
  return "stops after " + percent(s) + (line ? " of its length, at " : " of it, at ") +
         position_text(segment, s) + ": ";
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
  const double condition = manipulability_measures(task_jacobian(arm, q, task)).condition;
  const bool singular = condition >= regular_condition;
  const Probe ahead = solve_ahead(arm, segment, task, q, s, singular, budget);
  switch (ahead.answer.status) {
    case InverseStatus::solved:
      if (!singular) {
        return {MotionStatus::not_proved,
                where + "no step is proved to keep the tolerance; allow a larger one"};
      }
      return {MotionStatus::singular,
              where + (is_beginning(arm, segment, s)
                           ? singular_start_text(arm, task, q)
                           : "the arm is singular there; it could continue only by jumping to "
                             "another branch, such as another elbow")};
    case InverseStatus::outside_limits:
      return {MotionStatus::outside_limits, where + reason_at(segment, ahead)};
    case InverseStatus::unreachable:
    case InverseStatus::orientation_unreachable:
      return {MotionStatus::unreachable,
              where + unreachable_text(segment, ahead, probe(arm, segment, task, q, 1, budget))};
    case InverseStatus::time_limit:
    case InverseStatus::cancelled:
    case InverseStatus::work_limit:
      return {motion_status(ahead.answer.status), where + ahead.answer.reason};
    case InverseStatus::not_found:
      break;
  }
  const std::string near_singular =
      !singular ? "" : ", and the arm is singular there, as at the edge of its workspace";
  return {MotionStatus::not_found, where + "no configuration was found to continue with" +
                                       near_singular + "; " + reason_at(segment, ahead)};
}

SegmentFailure too_many_samples(std::size_t max_samples) {
  return {MotionStatus::too_many_samples, "needs more than " + std::to_string(max_samples) +
                                              " samples in all; allow a larger tolerance or "
                                              "more samples"};
}

}  // namespace beeline::internal
