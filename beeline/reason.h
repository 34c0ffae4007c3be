#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <beeline/budget.h>

namespace beeline {

/// What a computation found in the way of an answer, or of all of it.
enum class ReasonCode {
  none,
  // The budget ended a search; the field `ending` says by which limit.
  ended,
  ended_before_solution,
  ended_before_all_solutions,
  ended_before_best_solution,
  ended_on_path,
  ended_before_timing,
  ended_before_check,
  ended_before_sampling,
  ended_before_samples,
  ended_in_simulation,
  ended_in_retiming,
  ended_in_batch,
  ended_in_map,
  // Inverse kinematics.
  all_solutions_outside_limits,  ///< proved: every solution was examined
  solutions_outside_limits,      ///< those that were found
  no_solution_found,             ///< that none exists is not shown
  no_closed_form_solution,       ///< though a numerical search finds one
  position_unreachable,
  orientation_unreachable,
  beyond_reach,       ///< proved from the arm's reach, as are the next from its geometry
  tilted_off_axes,    ///< against the common direction of all joint axes
  off_plane,          ///< of an arm whose tool stays in a plane
  fixed_orientation,  ///< an arm of prismatic joints has another orientation
  off_slides,         ///< an arm of prismatic joints cannot translate there
  self_motion,        ///< solved: there are infinitely many solutions
  singular_velocity,  ///< no joint rates move the tool along a part of the velocity
  too_few_joints,     ///< the same at every configuration
  // Paths.
  would_pass_limits,    ///< of a joint, or of several, if the motion continued
  step_not_proved,      ///< no step keeps the tolerance
  singular_at_start,    ///< by the value of `joint`
  singular_on_path,     ///< the arm could continue only by jumping to another branch
  pose_outside_limits,  ///< details: inverse kinematics at the pose ahead
  path_leaves_workspace,
  path_loses_orientation,
  ended_at_pose,
  no_configuration_found,
  too_many_samples,
  path_not_proved,  ///< the tool is only proved to stay within a deviation of its path
  program_too_long,
  // Time.
  spline_outside_limits,  ///< between two samples
  end_speed_too_high,
  end_speed_unreachable,
  begin_speed_too_high,
  begin_speed_too_low,
  path_not_traversable,
  too_many_samples_at_rate,
  no_motion_at_rate,
  too_many_samples_given,
  duration_too_short,
  // Trajectories.
  outside_limits,  ///< a joint is outside its position limits at a sample
  moves_outside_limits,
  rotates_too_far,
  derivative_needed,   ///< over the next samples, above its limit
  derivative_reached,  ///< before the next sample, above its limit
  starts_moving,       ///< a trajectory that should start from rest
  ends_moving,         ///< a trajectory that should come to rest
  off_path,            ///< at a sample
  moves_backwards,     ///< at a sample
  deviation_unproved,  ///< up to the next sample
  leaves_path,         ///< up to the next sample
  may_move_backwards,  ///< up to the next sample
  leaves_last_waypoint,
  waypoint_not_reached,
  passes_without_rest,
  dwell_too_short,
  tool_too_fast,
  // Control.
  joint_outside_limits,  ///< of position
  goal_outside_limits,
  start_outside_limits,
  step_outside_limits,
  recording_outside_limits,          ///< at a sample
  recording_outside_limits_between,  ///< after a sample, by its velocities
  step_not_finite,
  not_converged,
  stagnates,
  diverges,
  next_solution_far,
  recording_too_fast,
  limit_exceeded,
  moves_after_lead_in,  ///< a recording that does not start at rest
  // Reachability.
  poses_too_far_apart,
  no_mount_reaches,
  no_mount_moves_in_lines,
};
std::string name(ReasonCode code);
ReasonCode reason_code_named(std::string_view name);  ///< throws Error for another name

/// What a reason says, by name. Numbers of moves, lines, segments, poses, samples and steps count
/// from 1, as files do. Metres, radians, seconds; a joint's values are in its `unit`, rad or m.
enum class ReasonField {
  // Where.
  move,
  move_name,
  line,
  lines,
  segment,
  segment_name,
  is_line,    ///< the segment is
  beginning,  ///< at the beginning of the path
  fraction,   ///< of the segment
  position,   ///< of the tool, in the world
  pose,
  poses,
  sample,
  time,
  step,
  s,  ///< path parameter
  // Who.
  arm,
  joint,
  unit,
  // How much.
  value,
  lower,
  upper,
  is_upper,  ///< the limit is the upper one
  limit,
  excess,
  quantity,  ///< position, velocity, acceleration or jerk
  use,       ///< fraction of the limit
  assumed,   ///< the limit is not known
  recorded,  ///< the limit is the recording's own
  distance,
  angle,
  change,
  centre,
  radius,
  nearest,
  speed,
  needed_speed,
  rate,
  duration,
  shortest_duration,
  dwell,
  beyond_dwells,
  error,
  count,
  of,
  starts,
  max_samples,
  more_samples,
  without_file,
  parts,
  // What kind.
  ending,
  interpolation,
  planned,
  refined,
  has_position,
  near_singular,
  oscillates,
  branches_complete,
  nearest_to_seed,
  direction,
  frame,
  // What else was tried, and what works.
  proof_rate,
  proved_rate,
  proved_speed,
  possible_rate,
  within_pose_tolerance,
  search_ending,
  search_limited,
  kept_speed,
  kept_at_rate,
  kept_rate,
  kept_ramp,
  kept_without_rate,
  speed_changes,
  shows_corners,
  none_kept,
  overshoots,
  at_singularity,
};
std::string name(ReasonField field);
ReasonField reason_field_named(std::string_view name);  ///< throws Error for another name

using ReasonValue = std::variant<bool, std::size_t, double, std::string, Eigen::Vector3d, Ending>;

/// Why there is no answer, or not the best: data. sentence() says it in English. A program asks for
/// `code` and the fields.
struct Reason {
  ReasonCode code = ReasonCode::none;
  std::vector<std::pair<ReasonField, ReasonValue>> fields = {};
  /// Other reasons that it rests on: inverse kinematics at poses of a path, further joints.
  std::vector<Reason> details = {};

  /// The value of a field; null where the reason has none.
  const ReasonValue* find(ReasonField field) const;
  bool has(ReasonField field) const { return find(field) != nullptr; }

  /// Sets a field, or replaces it.
  Reason& set(ReasonField field, ReasonValue value);

  explicit operator bool() const { return code != ReasonCode::none; }
  friend bool operator==(const Reason&, const Reason&) = default;
};

/// One sentence without a full stop; empty without a reason.
std::string sentence(const Reason& reason);
std::ostream& operator<<(std::ostream& out, const Reason& reason);  ///< sentence(reason)

}  // namespace beeline
