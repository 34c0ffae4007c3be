#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

using enum ReasonField;

/// "(0.1, 0, 0.3) m".
std::string place_of(const ReasonText& reason) { return point_text(reason.point(position)) + " m"; }

/// Empty for a configuration, which has no time, and if the name of a move stands before it.
std::string at_time(const ReasonText& reason) {
  return reason.has(time) && !reason.has(move_name) ? "at " + reason.number(time, " s ") : "";
}

/// The other body, with the index of its point: "scan[12]".
std::string other_of(const ReasonText& reason) {
  const std::string index = reason.has(point) ? "[" + reason.number(point) + "]" : "";
  return reason.text(other_body) + index;
}

/// "; finger is carried by joint slide, held at 0; the option hold sets another value,
/// slide=VALUE".
std::string held_advice(const ReasonText& reason) {
  if (!reason.has(held_joint)) return "";
  const std::string& joint = reason.text(held_joint);
  return "; " + reason.text(held_body) + " is carried by joint " + joint + ", held at " +
         reason.number(held_value) + "; the option hold sets another value, " + joint + "=VALUE";
}

std::string not_decided(const ReasonText& reason) {
  const std::string bodies = reason.text(body) + " is about " + reason.number(distance, " m") +
                             " from " + other_of(reason) + ", too near to the clearance of " +
                             reason.number(clearance, " m") + " to decide";
  if (!reason.has(begin)) return bodies;
  return "between " + reason.number(begin, " s") + " and " + reason.number(end, " s ") + bodies +
         "; a smaller clearance or a finer resolution decides";
}

}  // namespace

std::string clearance_sentence(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::bodies_collide:
      return at_time(reason) + reason.text(body) + " and " + other_of(reason) + " collide at " +
             place_of(reason) + ": a translation of " + reason.text(body) + " by " +
             reason.number(depth, " m") + " along " + point_text(reason.point(normal)) +
             " would separate them" + held_advice(reason);
    case ReasonCode::bodies_too_close:
      return at_time(reason) + reason.text(body) + " is " + reason.number(distance, " m") +
             " from " + other_of(reason) + " at " + place_of(reason) +
             ", closer than the clearance of " + reason.number(clearance, " m") +
             held_advice(reason);
    case ReasonCode::clearance_not_decided:
      return not_decided(reason);
    case ReasonCode::start_not_free:
      return "at the start " + sentence(reason.required_detail());
    case ReasonCode::goal_not_free:
      return (reason.number(count) == "1" ? "at the goal "
                                          : "at each of the " + reason.number(count) +
                                                " goals a limit or a clearance is not kept; at the "
                                                "first ") +
             sentence(reason.required_detail());
    case ReasonCode::no_free_path:
      return "no path was found that keeps the clearance, with " + reason.number(count) +
             " straight joint motions; one may exist";
    case ReasonCode::ended_before_free_path:
      return reason.ended() + " before a path was found that keeps the clearance, after " +
             reason.number(count) + " straight joint motions" + reason.how_to_continue();
    default:
      return "";
  }
}

}  // namespace beeline::internal
