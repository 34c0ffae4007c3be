#include <algorithm>
#include <ostream>

#include <beeline/internal/enum_names.h>
#include <beeline/internal/reason_text.h>
#include <beeline/reason.h>

namespace beeline {
namespace {

#ifdef BEELINE_SENTENCES_ARE_X
constexpr bool in_english = false;
#else
constexpr bool in_english = true;
#endif

using internal::EnumNames;
using internal::ReasonText;

constexpr EnumNames<ReasonCode::no_mount_moves_in_lines> code_names(
    "reason",
    "none "
    "ended ended_before_solution ended_before_all_solutions ended_before_best_solution "
    "ended_on_path ended_before_timing ended_before_check ended_before_sampling "
    "ended_before_samples ended_in_simulation ended_in_retiming ended_in_batch ended_in_map "
    "all_solutions_outside_limits solutions_outside_limits no_solution_found "
    "no_closed_form_solution position_unreachable orientation_unreachable beyond_reach "
    "tilted_off_axes off_plane fixed_orientation off_slides self_motion singular_velocity "
    "too_few_joints "
    "would_pass_limits step_not_proved singular_at_start singular_on_path pose_outside_limits "
    "path_leaves_workspace path_loses_orientation ended_at_pose no_configuration_found "
    "too_many_samples path_not_proved program_too_long "
    "spline_outside_limits end_speed_too_high end_speed_unreachable begin_speed_too_high "
    "begin_speed_too_low path_not_traversable too_many_samples_at_rate no_motion_at_rate "
    "too_many_samples_given duration_too_short "
    "outside_limits moves_outside_limits rotates_too_far derivative_needed derivative_reached "
    "starts_moving ends_moving off_path moves_backwards deviation_unproved leaves_path "
    "may_move_backwards leaves_last_waypoint waypoint_not_reached passes_without_rest "
    "dwell_too_short tool_too_fast "
    "joint_outside_limits goal_outside_limits start_outside_limits step_outside_limits "
    "recording_outside_limits recording_outside_limits_between step_not_finite not_converged "
    "stagnates diverges next_solution_far recording_too_fast limit_exceeded moves_after_lead_in "
    "poses_too_far_apart no_mount_reaches no_mount_moves_in_lines");

constexpr EnumNames<ReasonField::at_singularity> field_names(
    "field of a reason",
    "move move_name line lines segment segment_name is_line beginning fraction position pose "
    "poses sample time step s "
    "arm joint unit "
    "value lower upper is_upper limit excess quantity use assumed recorded distance angle "
    "change centre radius nearest speed needed_speed rate duration shortest_duration dwell "
    "beyond_dwells error count of starts max_samples more_samples without_file parts "
    "ending interpolation planned refined has_position near_singular oscillates "
    "branches_complete nearest_to_seed direction frame "
    "proof_rate proved_rate proved_speed possible_rate within_pose_tolerance search_ending "
    "search_limited kept_speed kept_at_rate kept_rate kept_ramp kept_without_rate speed_changes "
    "shows_corners none_kept overshoots at_singularity");

/// The place of a reason, before the sentence: "move 3 (line): ", "at 0.5 s, sample 51: ".
std::string place(const ReasonText& reason, bool of_time) {
  using enum ReasonField;
  std::string text;
  if (reason.has(move_name)) {
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
  if (reason.has(search_ending)) text += "; " + reason.ended(search_ending) + " for paths near it";
  if (reason.is(search_limited)) {
    text += "; the search for paths near it ended at its limit of work";
  }
  if (reason.is(within_pose_tolerance)) text += "; nor was one found within pose_tolerance";
  if (reason.is(overshoots)) text += "; the controller overshoots: the gains are too large";
  if (reason.is(at_singularity)) {
    text += "; the arm is at a singularity, where the Jacobian has no motion towards the goal";
  }
  return text + internal::replay_advice(reason);
}

}  // namespace

std::string name(ReasonCode code) { return code_names.of(code); }

ReasonCode reason_code_named(std::string_view name) { return code_names.named(name); }

std::string name(ReasonField field) { return field_names.of(field); }

ReasonField reason_field_named(std::string_view name) { return field_names.named(name); }

const ReasonValue* Reason::find(ReasonField field) const {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const auto& entry) { return entry.first == field; });
  return found == fields.end() ? nullptr : &found->second;
}

Reason& Reason::set(ReasonField field, ReasonValue value) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const auto& entry) { return entry.first == field; });
  if (found == fields.end()) {
    fields.emplace_back(field, std::move(value));
  } else {
    found->second = std::move(value);
  }
  return *this;
}

std::string sentence(const Reason& reason) {
  if (!reason) return "";
  if (!in_english) return "X";
  const ReasonText text(reason);
  const std::string of_time = internal::time_sentence(text);
  std::string said = of_time;
  for (auto* const group :
       {internal::inverse_sentence, internal::path_sentence, internal::trajectory_sentence,
        internal::control_sentence, internal::reach_sentence}) {
    if (said.empty()) said = group(text);
  }
  const bool timing = !of_time.empty() || reason.code == ReasonCode::joint_outside_limits;
  return place(text, timing) + said + others(text);
}

std::ostream& operator<<(std::ostream& out, const Reason& reason) {
  return out << sentence(reason);
}

}  // namespace beeline
