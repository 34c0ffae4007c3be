#include <ostream>

#include <beeline/reason.h>
#include <beeline/reason/reason_text.h>

namespace beeline {
namespace {

#ifdef BEELINE_SENTENCES_ARE_X
constexpr bool in_english = false;
#else
constexpr bool in_english = true;
#endif

using internal::ReasonText;

/// The place of a reason, before the sentence: "move 3 (line): ", "at 0.5 s, sample 51: ".
std::string place(const ReasonText& reason, bool of_time) {
  using enum ReasonField;
  std::string text;
  if (reason.has(move_name) && !reason.has(segment)) {  // the segment's name has the move's
    text += reason.text(move_name);
    if (reason.has(time) && !reason.has(sample)) text += ", at " + reason.number(time) + " s";
    text += ": ";
  }
  if (reason.has(line))
    text += "line " + reason.number(line) + " of " + reason.number(lines) + ": ";
  if (reason.is(beginning)) text += "the path's beginning: ";
  if (of_time && reason.has(segment_name)) {
    text += "up to the end of " + reason.text(segment_name) + ": ";
  }
  if (reason.has(pose)) {
    text += "at intermediate pose " + reason.number(pose) + " of " + reason.number(poses) + ": ";
  }
  if (reason.has(proof_rate)) {
    text += "at " + reason.number(proof_rate) + " samples per second ";
  }
  if (reason.has(sample)) {
    text += "at " + reason.number(time) + " s, sample " + reason.number(sample) + ": ";
  }
  return text;
}

/// Whether the clearance refuses a motion, for which another one may exist.
bool is_blocked(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::bodies_collide:
    case ReasonCode::bodies_too_close:
    case ReasonCode::clearance_not_decided:
      return true;
    default:
      return false;
  }
}

/// The other attempts, after the sentence.
std::string others(const ReasonText& reason) {
  using enum ReasonField;
  std::string text;
  if (reason.has(possible_rate)) text += "; a rate of " + reason.number(possible_rate) + " works";
  if (reason.has(more_samples)) {
    text += ", or more than " + reason.number(more_samples) + " samples";
  }
  if (reason.has(proved_rate)) text += ", or a rate of " + reason.number(proved_rate);
  if (reason.has(proved_speed)) text += ", or " + reason.number(proved_speed) + " times the speed";
  if (reason.has(search_ending)) {
    text += "; " + reason.ended(search_ending) +
            (is_blocked(reason) ? " for another motion" : " for paths near it");
  }
  if (reason.is(search_limited)) {
    text += "; the search for paths near it ended at its limit of work";
  }
  if (reason.is(within_pose_tolerance)) text += "; nor was one found within the pose tolerance";
  if (reason.is(in_millimetres)) {
    text += "; positions are in metres, and these numbers are probably in millimetres";
  }
  if (reason.is(in_degrees)) text += "; angles are in radians, and this one is probably in degrees";
  if (reason.is(overshoots)) text += "; the controller overshoots: the gains are too large";
  if (reason.is(at_singularity)) {
    text += "; the arm is at a singularity, where the Jacobian has no motion towards the goal";
  }
  return text + internal::replay_advice(reason);
}

}  // namespace

std::string sentence(const Reason& reason) {
  if (!reason) return "";
  if (!in_english) return "X";
  const ReasonText text(reason);
  const std::string of_time = internal::time_sentence(text);
  std::string said = of_time;
  for (auto* const group :
       {internal::inverse_sentence, internal::path_sentence, internal::trajectory_sentence,
        internal::clearance_sentence, internal::control_sentence, internal::reach_sentence}) {
    if (said.empty()) said = group(text);
  }
  const bool timing = !of_time.empty() || reason.code == ReasonCode::joint_outside_limits;
  return place(text, timing) + said + others(text);
}

std::ostream& operator<<(std::ostream& out, const Reason& reason) {
  return out << sentence(reason);
}

}  // namespace beeline
