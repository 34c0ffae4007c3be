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

/// Why a computation has no answer, or not the whole answer.
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
  solutions_outside_limits,      ///< every solution that was found exceeds a joint limit
  no_solution_found,             ///< a search found no solution; one may exist
  no_closed_form_solution,       ///< the closed form found none; a numerical search finds one
  position_unreachable,
  orientation_unreachable,
  beyond_reach,       ///< proved from the arm's reach; the next four are proved from its geometry
  tilted_off_axes,    ///< the pose is tilted relative to the common direction of all joint axes
  off_plane,          ///< the arm's tool stays in a plane, and the pose is outside it
  fixed_orientation,  ///< an arm of prismatic joints has another orientation
  off_slides,         ///< an arm of prismatic joints cannot translate there
  self_motion,        ///< solved: there are infinitely many solutions
  singular_velocity,  ///< no joint rates move the tool along a part of the velocity
  too_few_joints,     ///< no configuration has joint rates along this part
  // Paths.
  would_pass_limits,    ///< one or several joints would pass a limit if the motion continued
  step_not_proved,      ///< no step keeps the tolerance
  singular_at_start,    ///< the start is singular at this value of `joint`
  singular_on_path,     ///< the arm could continue only by jumping to another branch
  pose_outside_limits,  ///< `details` has the reason of inverse kinematics at the next pose
  path_leaves_workspace,
  path_loses_orientation,
  ended_at_pose,
  no_configuration_found,
  too_many_samples,
  path_not_proved,  ///< the tool is only proved to stay within a deviation of its path
  program_too_long,
  // Time.
  spline_outside_limits,  ///< a joint passes a limit between two samples
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
  derivative_needed,   ///< needed over the next samples, above its limit
  derivative_reached,  ///< reached before the next sample, above its limit
  starts_moving,       ///< a trajectory that should start from rest
  ends_moving,         ///< a trajectory that should come to rest
  off_path,            ///< the tool is off the path at a sample
  moves_backwards,     ///< the tool is behind an earlier sample
  deviation_unproved,  ///< the deviation up to the next sample is not proved
  leaves_path,         ///< the tool leaves the path before the next sample
  may_move_backwards,  ///< the tool may move backwards before the next sample
  leaves_last_waypoint,
  waypoint_not_reached,
  passes_without_rest,
  dwell_too_short,
  tool_too_fast,
  // Control.
  joint_outside_limits,  ///< a joint is outside its position limits
  goal_outside_limits,
  start_outside_limits,
  step_outside_limits,
  recording_outside_limits,          ///< the recording leaves the limits at a sample
  recording_outside_limits_between,  ///< the recording leaves the limits after a sample, by its
                                     ///< velocities
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

/// The names of the values in a reason. Numbers of moves, lines, segments, poses, samples and steps
/// count from 1, as in files. Units are metres, radians and seconds; the values of a joint are in
/// its `unit`, rad or m.
enum class ReasonField {
  // Where.
  move,
  move_name,
  line,
  lines,
  segment,
  segment_name,
  is_line,    ///< whether the segment is a line
  beginning,  ///< whether the place is the beginning of the path
  fraction,   ///< fraction of the segment
  position,   ///< position of the tool in the world
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
  is_upper,  ///< whether the limit is the upper one
  limit,
  excess,
  quantity,  ///< position, velocity, acceleration or jerk
  use,       ///< value as a fraction of the limit
  assumed,   ///< whether the limit is assumed, because it is not known
  recorded,  ///< whether the limit is the recording's own
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

/// Why there is no answer, or not the best one, as data. sentence() writes it in English. A program
/// reads `code` and the fields.
struct Reason {
  ReasonCode code = ReasonCode::none;
  std::vector<std::pair<ReasonField, ReasonValue>> fields = {};
  /// Other reasons that explain this one: inverse kinematics at poses of a path, further
  /// joints.
  std::vector<Reason> details = {};

  /// Returns the value of a field; null if the reason does not have it.
  const ReasonValue* find(ReasonField field) const;
  bool has(ReasonField field) const { return find(field) != nullptr; }

  /// Sets a field, or replaces it.
  Reason& set(ReasonField field, ReasonValue value);

  explicit operator bool() const { return code != ReasonCode::none; }
  friend bool operator==(const Reason&, const Reason&) = default;
};

/// Returns one sentence without a full stop; empty without a reason.
std::string sentence(const Reason& reason);
std::ostream& operator<<(std::ostream& out, const Reason& reason);  ///< sentence(reason)

}  // namespace beeline
