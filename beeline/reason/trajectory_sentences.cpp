#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

using enum ReasonField;

/// "its limits of 0 to 1 rad", with the excess if the digits do not show it.
std::string range(const ReasonText& reason) {
  return "its limits of " + reason.number(lower) + " to " + reason.in_unit(upper) +
         excess_if_alike(reason);
}

/// "1.2 rad/s^2 over the next samples; its limit is 1 rad/s^2", with the digits that differ.
std::string above_limit(const ReasonText& reason, const std::string& where) {
  const std::string& of = reason.text(quantity);
  const std::string per = " " + reason.text(unit) +
                          (of == "velocity"       ? "/s"
                           : of == "acceleration" ? "/s^2"
                                                  : "/s^3");
  const std::string allowed = reason.number(limit) + per;
  return number_apart(reason.value(value), reason.value(limit)) + per + where +
         (reason.is(assumed) ? "; its limit is not known, " + allowed +
                                   " is assumed; give the joint's " + of + " limit"
                             : "; its limit is " + allowed);
}

std::string of_joint(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::outside_limits:
      return "is at " + reason.in_unit(value) + ", outside " + range(reason);
    case ReasonCode::moves_outside_limits:
      return "moves to " + reason.in_unit(value) + " before the next sample, by the " +
             reason.text(interpolation) + " with its velocities: outside " + range(reason);
    case ReasonCode::excess_rises:
      return "starts outside its limits and does not return steadily: at " + reason.in_unit(value) +
             ", outside " + range(reason) + ", it moves out by " + reason.in_unit(change);
    case ReasonCode::rotates_too_far:
      return "rotates by " + reason.number(change) + " rad to the next sample, " +
             number(std::abs(reason.value(change)) / (2 * std::numbers::pi)) + " revolutions";
    case ReasonCode::derivative_needed:
      return "needs " + above_limit(reason, " over the next samples");
    case ReasonCode::derivative_reached:
      return "reaches " + above_limit(reason, " before the next sample");
    case ReasonCode::starts_moving:
    case ReasonCode::ends_moving:
      return std::string(reason.code() == ReasonCode::starts_moving ? "starts" : "ends") + " at " +
             reason.in_unit(value) + "/s, not at rest";
    default:
      return "";
  }
}

/// "; a joint moves by 0.7, as at a change of branch".
std::string jump(const ReasonText& reason) {
  return reason.has(change)
             ? "; a joint moves by " + reason.number(change) + ", as at a change of branch"
             : "";
}

/// "; its blend allows 0.02 m and 0.1 rad, and joint elbow is 0.5 rad from the waypoint's value".
std::string beyond_blend(const ReasonText& reason) {
  if (!reason.has(limit)) return "";
  std::string text = "; its blend allows " + reason.number(limit) + " m and " +
                     reason.number(angle_limit) + " rad";
  if (!reason.has(joint)) return text;
  return text + ", and joint " + reason.text(joint) + " is " + reason.number(error) + " " +
         reason.text(unit) + " from the waypoint's value";
}

std::string of_tool(const ReasonText& reason) {
  const std::string path = reason.is(is_line) ? "line" : "path";
  switch (reason.code()) {
    case ReasonCode::off_path:
      return "the tool is off " + reason.text(segment_name) + " by " + reason.deviation() +
             beyond_blend(reason);
    case ReasonCode::moves_backwards:
      return "the tool moves backwards on " + reason.text(segment_name) + " by " +
             reason.deviation();
    case ReasonCode::may_move_backwards:
      return "up to the next sample the tool moves backwards on " + reason.text(segment_name) +
             " by up to " + reason.deviation_bound();
    case ReasonCode::deviation_unproved:
      return "up to the next sample the tool is only proved to stay within " +
             reason.deviation_bound() + " of the " + path + jump(reason);
    case ReasonCode::leaves_path:
      return "up to the next sample the tool leaves the " + path + " by " + reason.deviation() +
             jump(reason);
    default:
      return "";
  }
}

std::string of_waypoint(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::leaves_last_waypoint:
      return reason.has(distance) ? "the tool leaves the last waypoint by " + reason.deviation()
                                  : "the arm leaves the last waypoint";
    case ReasonCode::waypoint_not_reached:
      return reason.text(segment_name) + " is not reached; at the end the tool is " +
             reason.deviation() + " from it";
    case ReasonCode::passes_without_rest:
      return "the arm passes the waypoint of " + reason.text(segment_name) +
             ", where it has to be at rest";
    case ReasonCode::dwell_too_short:
      return "the arm is at rest for " + reason.number(duration) + " s at the waypoint of " +
             reason.text(segment_name) + ", " +
             number(reason.value(dwell) - reason.value(duration)) + " s less than the dwell of " +
             reason.number(dwell) + " s" +
             (reason.is(beyond_dwells) ? ", beyond the dwells before" : "");
    case ReasonCode::tool_too_fast:
      return "on " + reason.text(segment_name) + " the tool's speed is up to " +
             reason.number(speed) + " m/s, above " + reason.number(limit) + " m/s";
    default:
      return "";
  }
}

}  // namespace

std::string trajectory_sentence(const ReasonText& reason) {
  if (reason.code() == ReasonCode::ended_before_check) {
    return reason.ended() + " before the whole trajectory was checked" + reason.how_to_continue();
  }
  if (const std::string text = of_joint(reason); !text.empty()) return reason.joint() + " " + text;
  const std::string text = of_tool(reason);
  return text.empty() ? of_waypoint(reason) : text;
}

}  // namespace beeline::internal
