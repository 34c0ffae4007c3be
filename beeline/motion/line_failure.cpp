#include <beeline/error.h>
#include <beeline/inverse/solve.h>
#include <beeline/motion/line_failure.h>
#include <beeline/motion/time_law.h>

namespace beeline {
namespace {

constexpr double ahead = 1e-3;     // of the line: far enough to tell a wall from rounding
constexpr double at_limit = 1e-6;  // radians or metres from a limit that count as at it

/// The coordinates of q that are at a limit, as a phrase; empty when there are none.
std::string joints_at_limits(const Arm& arm, const Configuration& q) {
  std::string text;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits()[static_cast<std::size_t>(k)];
    const bool low = q[k] - limits.lower < at_limit;
    if (!low && limits.upper - q[k] >= at_limit) continue;
    const double limit = low ? limits.lower : limits.upper;
    const bool metres = kind(arm.joint_of(k)) == JointKind::prismatic;
    text += (text.empty() ? "" : ", ") + ("joint " + arm.joint_of(k).name) + " is at its " +
            (low ? "lower" : "upper") + " limit of " +
            (metres ? number(limit) + " m" : angle(limit));
  }
  return text;
}

std::string place(const Line& line, double s) {
  const Vector3 p = interpolate(line.from, line.to, s).translation();
  return "stops after " + number(100 * s) + " % of its length, at x " + number(p.x()) + ", y " +
         number(p.y()) + ", z " + number(p.z()) + " m: ";
}

}  // namespace

LineFailure line_failure(const Arm& arm, const Line& line, const Task& task, const Configuration& q,
                         double u) {
  const double s = rest_to_rest(u);
  const std::string where = place(line, s);
  const std::string held = joints_at_limits(arm, q);
  if (!held.empty()) {
    return {MotionStatus::outside_limits, where + held + " and would have to pass it"};
  }
  const Pose next = interpolate(line.from, line.to, std::min(1.0, s + ahead));
  const InverseResult answer = inverse_kinematics(arm, next, {.seed = q, .task = task});
  if (answer.status == InverseStatus::solved) {
    return {MotionStatus::singular,
            where +
                "the arm is singular there; it could go on only by jumping to another branch, "
                "such as another elbow"};
  }
  if (answer.status == InverseStatus::outside_limits) {
    return {MotionStatus::outside_limits, where + answer.reason};
  }
  return {MotionStatus::unreachable,
          where + "the line leaves the arm's workspace there; " + answer.reason};
}

LineFailure too_many_samples(int most) {
  return {MotionStatus::not_converged,
          "needs more than " + std::to_string(most) +
              " samples in all; allow a larger tolerance or more samples"};
}

}  // namespace beeline
