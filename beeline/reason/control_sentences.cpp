#include <beeline/error.h>
#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

using enum ReasonField;

std::string simulated(const ReasonText& reason) {
  const std::string oscillating = "the motion oscillates, the gain is too large";
  const bool one = reason.has(step) && reason.number(step) == "1";
  switch (reason.code()) {
    case ReasonCode::step_not_finite:
      return "the step of the controller is not finite";
    case ReasonCode::step_outside_limits:
      return "step " + reason.number(step) + " would leave the limits: " + outside_text(reason);
    case ReasonCode::not_converged:
      return "after " + reason.number(step) + (one ? " step" : " steps") + " the error is " +
             reason.number(error) + ": " +
             (reason.is(oscillates) ? oscillating : "the gain is too small, or allow more steps");
    case ReasonCode::stagnates:
      return "the error has stayed at " + reason.number(error) + " or above for " +
             reason.number(count) +
             " steps: " + (reason.is(oscillates) ? oscillating : "the arm is stuck");
    case ReasonCode::diverges:
      return "the error diverges, to " + reason.number(error) + " after " + reason.number(step) +
             " steps: the gain is too large";
    case ReasonCode::next_solution_far:
      return "the nearest solution is another branch, " + reason.angle(change) +
             " away; more intermediate poses may help";
    case ReasonCode::ended_in_simulation:
      return reason.ended() + " after " + reason.number(step) + " steps, with an error of " +
             reason.number(error) + reason.how_to_continue();
    default:
      return "";
  }
}

/// "at 0.5 s joint elbow uses 1.2 times its acceleration limit".
std::string exceeded(const ReasonText& reason) {
  const std::string where = "at " + reason.number(time) + " s " + reason.joint();
  const std::string& of = reason.text(quantity);
  if (of == "position")
    return where + " is " + reason.in_unit(excess) + " beyond its position limit";
  const std::string times = where + " uses " + number_apart(reason.value(use), 1) + " times ";
  if (reason.is(recorded)) return times + "the recording's own " + of;
  return times + "its " + (reason.is(assumed) ? "assumed " : "") + of + " limit";
}

std::string replayed(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::start_outside_limits:
      return "the start: " + outside_text(reason);
    case ReasonCode::recording_outside_limits:
      return "at " + reason.number(time) + " s " + outside_text(reason);
    case ReasonCode::recording_outside_limits_between:
      return "after " + reason.number(time) + " s " + outside_text(reason) +
             ", by the velocities of the recording";
    case ReasonCode::recording_too_fast:
      return "at " + reason.number(time) + " s " + reason.joint() + " moves at " +
             number_apart(reason.value(use), 1) + " times its velocity limit";
    case ReasonCode::limit_exceeded:
      return (reason.has(rate) ? "with " + reason.number(rate) + " samples per second " : "") +
             exceeded(reason) + (reason.has(speed) ? " at a speed of " + reason.number(speed) : "");
    case ReasonCode::moves_after_lead_in:
      return "after the lead-in, " + exceeded(reason) + ": the recording does not start at rest";
    case ReasonCode::ended_before_samples:
      return reason.ended() + " before samples within the limits were found" +
             reason.how_to_continue();
    default:
      return "";
  }
}

}  // namespace

std::string control_sentence(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::joint_outside_limits:
      return outside_text(reason);
    case ReasonCode::goal_outside_limits:
      return "the goal is outside the limits: " + outside_text(reason);
    case ReasonCode::ended_before_sampling:
      return reason.ended() + " before the motion was sampled" + reason.how_to_continue();
    default: {
      const std::string text = simulated(reason);
      return text.empty() ? replayed(reason) : text;
    }
  }
}

std::string replay_advice(const ReasonText& reason) {
  if (reason.is(none_kept)) return "; no other rate, ramp or speed was found that keeps the limits";
  if (reason.is(kept_without_rate))
    return "; the recorded samples, without a rate, keep the limits";
  if (reason.has(kept_ramp)) {
    return "; a ramp of " + reason.number(kept_ramp) + " s keeps the limits";
  }
  std::string text;
  const bool several = reason.is(speed_changes) && !reason.has(kept_rate);
  if (reason.has(kept_speed)) {
    text = (reason.is(speed_changes) ? "; speeds of at most " : "; a speed of ") +
           reason.number(kept_speed) + (reason.is(kept_at_rate) ? " at this rate" : "");
  }
  if (reason.has(kept_rate)) {
    text += (text.empty() ? "; a rate of " : ", or a rate of ") + reason.number(kept_rate);
  }
  if (text.empty()) return text;
  return text + (several ? " keep the limits" : " keeps the limits") +
         (reason.is(shows_corners)
              ? "; the recording is linear between its samples, and finer sampling shows the "
                "corners, which retime() smooths"
              : "");
}

}  // namespace beeline::internal
