#include <algorithm>
#include <optional>

#include <beeline/error.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/planning/internal/segment_failure.h>

namespace beeline {
namespace {

// How far ahead to look, in lengths of the segment: just behind the wall, and clearly behind it.
constexpr double looks[] = {1e-6, 1e-5, 1e-4, 1e-3};
constexpr double farther = 1e-4;   // of them, that a motion stopped by limits would go on
constexpr double regular = 1e3;    // a condition below: the arm is far from singular
constexpr double next_door = 0.2;  // radians or metres: farther away is another branch

/// The joints that q takes out of their limits, as a phrase; empty when there are none.
std::string joints_outside(const Arm& arm, const Configuration& q) {
  std::string text;
  for (const int k : outside_limits(arm, q, 0)) {
    text += (text.empty() ? "" : ", and ") + limit_in_the_way(arm, k, q[k] < arm.limits(k).lower);
  }
  return text;
}

/// What the motion would go on to without limits, if that is outside of them; nothing where it
/// would come to an end at once even so.
std::string passed_limits(const Arm& arm, const Segment& segment, const Task& task,
                          const Configuration& q, double s) {
  std::string joints;
  for (const double look : looks) {
    const Pose next = pose_at(segment, std::min(1.0, s + look));
    const internal::NumericalResult free =
        internal::levenberg_marquardt(arm, next, task, internal::no_bounds(arm), q);
    if (!free.converged || (free.q - q).lpNorm<Eigen::Infinity>() > next_door) return {};
    if (joints.empty()) joints = joints_outside(arm, free.q);
    if (!joints.empty() && look >= farther) return joints;
  }
  return {};
}

}  // namespace

std::string place_in_words(const Segment& segment, double s) {
  const Vector3 p = pose_at(segment, s).translation();
  const bool line = std::holds_alternative<Line>(segment);
  return "stops after " + number(100 * s) + (line ? " % of its length, at x " : " % of it, at x ") +
         number(p.x()) + ", y " + number(p.y()) + ", z " + number(p.z()) + " m: ";
}

std::string limit_in_the_way(const Arm& arm, int coordinate, bool lower) {
  const Limits& limits = arm.limits(coordinate);
  const double limit = lower ? limits.lower : limits.upper;
  const Joint& joint = arm.joint_of(coordinate);
  return "joint " + joint.name + " would have to pass its " + (lower ? "lower" : "upper") +
         " limit of " + with_unit(joint, limit);
}

SegmentFailure segment_failure(const Arm& arm, const Segment& segment, const Task& task,
                               const Configuration& q, double s) {
  const std::string where = place_in_words(segment, s);
  const std::string joints = passed_limits(arm, segment, task, q, s);
  if (!joints.empty()) return {MotionStatus::outside_limits, where + joints};

  // Next to the edge of the workspace solutions are nearly there: that none exists shows farther
  // on.
  InverseResult answer;
  for (const double look : {1e-3, 1e-2, 1e-1}) {
    const Pose next = pose_at(segment, std::min(1.0, s + look));
    InverseResult ahead = inverse_kinematics(arm, next, {.seed = q, .task = task});
    const bool none = ahead.status == InverseStatus::unreachable ||
                      ahead.status == InverseStatus::orientation_unreachable;
    if (answer.reason.empty() || none) answer = std::move(ahead);
    if (answer.status != InverseStatus::not_found) break;
  }
  const double condition = dexterity(task_jacobian(arm, q, task)).condition;
  switch (answer.status) {
    case InverseStatus::solved:
      if (condition < regular) {
        return {MotionStatus::not_converged,
                where + "the steps became too small to go on; allow a larger tolerance"};
      }
      return {MotionStatus::singular,
              where +
                  "the arm is singular there; it could go on only by jumping to another branch, "
                  "such as another elbow"};
    case InverseStatus::outside_limits:
      return {MotionStatus::outside_limits, where + answer.reason};
    case InverseStatus::unreachable:
      return {MotionStatus::unreachable,
              where + "the way leaves the arm's workspace; " + answer.reason};
    case InverseStatus::orientation_unreachable:
      return {MotionStatus::unreachable, where + answer.reason};
    case InverseStatus::not_found:
      break;
  }
  const std::string edge =
      condition < regular ? "" : ", where the arm is singular, as at the edge of its workspace";
  return {MotionStatus::not_found, where + "no way on was found" + edge + "; " + answer.reason};
}

SegmentFailure too_many_samples(int most) {
  return {MotionStatus::not_converged,
          "needs more than " + std::to_string(most) +
              " samples in all; allow a larger tolerance or more samples (--most-samples)"};
}

}  // namespace beeline
