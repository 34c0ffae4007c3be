#include <cmath>

#include <beeline/error.h>
#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

using enum ReasonField;

std::string position_text(const Eigen::Vector3d& p) {
  constexpr double rounding = 1e-12;  // metres
  const auto text = [](double x) { return number(std::abs(x) < rounding ? 0 : x); };
  return "x " + text(p.x()) + ", y " + text(p.y()) + ", z " + text(p.z()) + " m";
}

/// "joint elbow would have to pass its upper limit of 1 rad (57.3 deg)".
std::string passed_limit(const ReasonText& reason) {
  return reason.joint() + " would have to pass its " + (reason.is(is_upper) ? "upper" : "lower") +
         " limit of " + reason.joint_value(limit);
}

/// The reason of inverse kinematics at a pose of the path, with its place.
std::string at_pose(const Reason& detail) {
  const ReasonText reason(detail);
  const double s = reason.value(fraction);
  return (s == 1 ? "at its end" : "after " + number(100 * s) + " %") + ", at " +
         position_text(reason.point(position)) + ", " + inverse_sentence(reason);
}

std::string at_poses(const ReasonText& reason) {
  std::string text;
  for (const Reason& detail : reason.required_details())
    text += (text.empty() ? "" : "; ") + at_pose(detail);
  return text;
}

/// The place of a stop: "line 2 of 3 stops after 63.1 % of its length, at x 0.1, y 0.2, z 0.3 m: ".
std::string stop(const ReasonText& reason) {
  if (!reason.has(fraction)) return "";
  return "stops after " + percent(reason.value(fraction)) +
         (reason.is(is_line) ? " of its length, at " : " of it, at ") +
         position_text(reason.point(position)) + ": ";
}

std::string singular_start(const ReasonText& reason) {
  return "the arm is singular at this start, " +
         (reason.has(joint) ? "with " + reason.joint() + " at " + reason.joint_value(value) + ", "
                            : "") +
         "so the tool can leave it in this direction only with a jump of the joints" +
         (reason.has(joint) ? "; with another value of this joint it is not singular" : "");
}

std::string on_path(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::would_pass_limits: {
      std::string text = passed_limit(reason);
      for (const Reason& other : reason.details())
        text += ", and " + passed_limit(ReasonText(other));
      return text;
    }
    case ReasonCode::step_not_proved:
      return "no step is proved to keep the tolerance" + advice(reason, "allow a larger one");
    case ReasonCode::singular_at_start:
      return singular_start(reason);
    case ReasonCode::singular_on_path:
      return "the arm is singular there; it could continue only by jumping to another branch, "
             "such as another elbow";
    case ReasonCode::pose_outside_limits:
      return at_poses(reason);
    case ReasonCode::path_leaves_workspace:
      return "the path leaves the arm's workspace; " + at_poses(reason) +
             "; a larger tolerance does not help";
    case ReasonCode::path_loses_orientation: {
      const bool positions_end =
          reason.details().size() > 1;  // the position is out of reach at one of them
      return "the arm cannot keep the path's orientation; " + at_poses(reason) +
             "; a larger tolerance does not help" +
             (positions_end ? "" : ", a task that leaves rotations free may");
    }
    case ReasonCode::ended_at_pose:
      return inverse_sentence(ReasonText(reason.required_detail()));
    case ReasonCode::no_configuration_found:
      return std::string("no configuration was found to continue with") +
             (reason.is(near_singular)
                  ? ", and the arm is singular there, as at the edge of its workspace"
                  : "") +
             "; " + at_poses(reason);
    default:
      return "";
  }
}

/// "line 2 of 3 ", "move 3 (line) ".
std::string segment_text(const ReasonText& reason) {
  return reason.has(segment_name) ? reason.text(segment_name) + " " : "";
}

/// " after it had followed line 2 of 3 to 63.1 %".
std::string followed(const ReasonText& reason) {
  if (!reason.has(fraction)) return "";
  return " after it had followed " +
         (reason.has(segment) ? segment_text(reason) + "to " + percent(reason.value(fraction))
                              : "the whole path");
}

}  // namespace

std::string path_sentence(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::ended:
      return reason.ended() + reason.how_to_continue();
    case ReasonCode::too_many_samples:
      return segment_text(reason) + "needs more than " + reason.number(max_samples) +
             " samples in all" + advice(reason, "allow a larger tolerance or more samples");
    case ReasonCode::path_not_proved:
      return "the tool is only proved to stay within " + reason.deviation_bound() + " of its path" +
             advice(reason, "allow a larger tolerance");
    case ReasonCode::program_too_long:
      return "the motion up to here needs more than " + reason.number(max_samples) +
             " samples; lower the rate";
    case ReasonCode::ended_on_path:
      return reason.ended() + followed(reason) + reason.how_to_continue();
    default: {
      const std::string text = on_path(reason);
      return text.empty() ? text : segment_text(reason) + stop(reason) + text;
    }
  }
}

}  // namespace beeline::internal
