#include <beeline/error.h>
#include <beeline/reason/reason_text.h>

namespace beeline::internal {

using enum ReasonField;

std::string time_sentence(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::ended_before_timing:
      return reason.ended() +
             " after the whole path was planned, before the motion was timed and proved" +
             reason.how_to_continue();
    case ReasonCode::ended_in_retiming:
      return reason.ended() + " after " + reason.number(count) + " of " + reason.number(of) +
             " sections between stops" + reason.how_to_continue();
    case ReasonCode::spline_outside_limits:
      return "between two samples the spline through them leaves the limits: " +
             outside_text(reason) +
             advice(reason, reason.is(planned)
                                ? "begin and stop farther inside them"
                                : "straight joint motions with blends stay within them");
    case ReasonCode::end_speed_too_high:
      return "the speed at the path's end is above its limits: " + reason.number(speed) +
             " instead of " + reason.number(needed_speed);
    case ReasonCode::end_speed_unreachable:
      return "the speed at the path's end cannot be reached: no speed at s = " + reason.number(s) +
             " leads to it within the limits";
    case ReasonCode::begin_speed_too_high:
    case ReasonCode::begin_speed_too_low:
      return "the speed at the path's beginning, " + reason.number(speed) + ", is too " +
             (reason.code() == ReasonCode::begin_speed_too_high ? "high" : "low") +
             " for the rest of the path, which needs " + reason.number(needed_speed);
    case ReasonCode::path_not_traversable:
      return "the path cannot be traversed from s = " + reason.number(s);
    case ReasonCode::too_many_samples_at_rate:
      return reason.number(rate) + " samples per second make more than " +
             reason.number(max_samples) + " in " + reason.number(duration) + " s";
    case ReasonCode::no_motion_at_rate:
      return "no motion within the limits was found at " + reason.number(rate) +
             " samples per second";
    case ReasonCode::too_many_samples_given:
      return "the trajectory has " + reason.number(count) + " samples, more than " +
             reason.number(max_samples) + "; allow more samples";
    case ReasonCode::duration_too_short:
      return "a duration of " + reason.number(duration) +
             " s is too short: the shortest within the limits is " +
             number_at_least(reason.value(shortest_duration)) + " s";
    default:
      return "";
  }
}

}  // namespace beeline::internal
