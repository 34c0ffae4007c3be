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
  none,  ///< there is an answer
  // The budget ended a search; the field `ending` says by which limit.
  ended,                       ///< the search ended, and nothing else is known
  ended_before_solution,       ///< no solution was found yet; `distance` of the nearest
  ended_before_all_solutions,  ///< `count` were found
  ended_before_best_solution,  ///< the one given is the best so far
  ended_on_path,               ///< the path was followed up to this place
  ended_before_free_path,      ///< after `count` straight joint motions
  ended_before_timing,         ///< the path was planned, not timed
  ended_before_check,          ///< the trajectory was not wholly checked
  ended_before_sampling,       ///< the motion was timed, not sampled
  ended_before_samples,        ///< no samples within the limits were found yet
  ended_in_simulation,         ///< after some steps of a controller
  ended_in_retiming,           ///< `count` of `of` sections were retimed
  ended_in_batch,              ///< `count` rows were computed
  ended_in_map,                ///< a part of a reach map was computed
  // Inverse kinematics.
  all_solutions_outside_limits,  ///< proved: every solution was examined
  solutions_outside_limits,      ///< every solution that was found exceeds a joint limit
  all_solutions_blocked,  ///< proved: every solution was examined and is blocked; `details` has why
  solutions_blocked,      ///< every solution that was found is blocked; `details` has why
  no_solution_found,      ///< a search found no solution; one may exist
  no_closed_form_solution,  ///< the closed form found none; a numerical search finds one
  position_unreachable,     ///< no search brings the tool to the position
  orientation_unreachable,  ///< the tool comes to the position, not with this orientation
  // Proved from the arm's geometry: tilted_off_axes, off_plane, fixed_orientation and off_slides.
  tilted_off_axes,    ///< the pose is tilted relative to the common direction of all joint axes
  off_plane,          ///< the arm's tool stays in a plane, and the pose is outside it
  fixed_orientation,  ///< an arm of prismatic joints has another orientation
  off_slides,         ///< an arm of prismatic joints cannot translate there
  self_motion,        ///< solved: there are infinitely many solutions
  singular_velocity,  ///< no joint rates move the tool along a part of the velocity
  too_few_joints,     ///< no configuration has joint rates along this part
  // Paths.
  would_pass_limits,       ///< one or several joints would pass a limit if the motion continued
  step_not_proved,         ///< no step keeps the tolerance
  singular_at_start,       ///< the start is singular at this value of `joint`
  singular_on_path,        ///< the arm could continue only by jumping to another branch
  pose_outside_limits,     ///< `details` has the reason of inverse kinematics at the next pose
  path_leaves_workspace,   ///< the path passes poses that the tool cannot reach
  path_loses_orientation,  ///< the tool reaches the positions ahead, not the orientations
  ended_at_pose,           ///< inverse kinematics at the next pose was ended
  no_configuration_found,  ///< no configuration for a pose of the path
  too_many_samples,        ///< the branch needs more than `max_samples`
  path_not_proved,         ///< the tool is only proved to stay within a deviation of its path
  program_too_long,        ///< the moves need more than `max_samples` together
  // Time.
  spline_outside_limits,     ///< a joint passes a limit between two samples
  end_speed_too_high,        ///< the speed at the end of a section exceeds what its stop allows
  end_speed_unreachable,     ///< the section is too short for it
  begin_speed_too_high,      ///< the speed at the beginning of a section is too high
  begin_speed_too_low,       ///< the speed at the beginning of a section is too low
  path_not_traversable,      ///< no time scaling keeps the limits
  too_many_samples_at_rate,  ///< the rate needs more than `max_samples`
  no_motion_at_rate,         ///< at this rate no motion keeps the limits
  too_many_samples_given,    ///< the recording has more than `max_samples`
  duration_too_short,        ///< less than the shortest within the limits
  // Trajectories.
  outside_limits,        ///< a joint is outside its position limits at a sample
  moves_outside_limits,  ///< a joint leaves its limits between two samples
  excess_rises,          ///< a joint that starts outside its limits moves farther out
  rotates_too_far,       ///< a joint rotates by half a revolution or more: Fault::flip
  derivative_needed,     ///< needed over the next samples, above its limit
  derivative_reached,    ///< reached before the next sample, above its limit
  starts_moving,         ///< a trajectory that should start from rest
  ends_moving,           ///< a trajectory that should come to rest
  off_path,              ///< the tool is off the path at a sample
  moves_backwards,       ///< the tool is behind an earlier sample
  deviation_unproved,    ///< the deviation up to the next sample is not proved
  leaves_path,           ///< the tool leaves the path before the next sample
  may_move_backwards,    ///< the tool may move backwards before the next sample
  leaves_last_waypoint,  ///< the motion goes on after the last waypoint
  waypoint_not_reached,  ///< the motion ends before it
  passes_without_rest,   ///< a program stops there, the motion does not
  dwell_too_short,       ///< the motion rests less than the program asks for
  tool_too_fast,         ///< above the limit of the tool speed
  // Clearance.
  bodies_collide,         ///< two bodies overlap or touch
  bodies_too_close,       ///< two bodies are closer than their clearance
  clearance_not_decided,  ///< two bodies are as close as their clearance, to the resolution
  // Motions around obstacles.
  start_not_free,  ///< the start of a free path; `details` has why
  goal_not_free,   ///< none of its `count` goals; `details` has why the first is not
  no_free_path,    ///< none was found with `count` straight joint motions; one may exist
  // A configuration. Codes of joints outside their limits differ in the configuration: solutions of
  // a pose (`solutions_outside_limits`, `all_solutions_outside_limits`), the next one on a path
  // (`would_pass_limits`, `pose_outside_limits`), a trajectory at and between its samples
  // (`outside_limits`, `moves_outside_limits`), a motion that is being timed
  // (`spline_outside_limits`), a controller (under Control). The code here is for a configuration
  // that was given, such as a start.
  joint_outside_limits,  ///< a joint is outside its position limits
  // Control.
  goal_outside_limits,               ///< the goal of a controller is outside the limits
  start_outside_limits,              ///< the start of a controller is outside the limits
  step_outside_limits,               ///< a step of a controller leaves the limits
  recording_outside_limits,          ///< the recording leaves the limits at a sample
  recording_outside_limits_between,  ///< the recording leaves the limits after a sample, by its
                                     ///< velocities
  step_not_finite,                   ///< a step of a controller is no number
  not_converged,                     ///< the controller did not arrive within its steps
  stagnates,                         ///< the error no longer decreases
  diverges,                          ///< the error grows
  next_solution_far,                 ///< the next solution is on another branch
  recording_too_fast,   ///< the recording exceeds the velocity limits at this speed scale
  limit_exceeded,       ///< a replayed recording exceeds a limit
  moves_after_lead_in,  ///< a recording that does not start at rest
  // Reachability.
  poses_too_far_apart,  ///< the poses are farther apart than the arm reaches
  no_mount_reaches,  ///< the arm reaches all poses from none of the mounts that the map ranks first
  no_mount_moves_in_lines,  ///< the poses are reached, lines between them are not possible
  // Batches.
  poses_unsolved,  ///< `count` of `of` poses have no solution
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
  begin,  ///< begin of a range of times
  end,    ///< end of the range
  step,
  s,  ///< path parameter
  // Who.
  arm,
  joint,
  unit,
  body,        ///< link or obstacle
  other_body,  ///< link or obstacle
  point,       ///< index from 0 of a point of `other_body`, if that is a point cloud
  held_body,   ///< the one of two bodies that a joint beside the chain carries
  held_joint,  ///< that joint
  held_value,  ///< the value at which it is held, rad or m
  // How much.
  value,
  lower,
  upper,
  is_upper,  ///< whether the limit is the upper one
  limit,
  angle_limit,  ///< max deviation of the orientation, where `limit` is the position's
  excess,
  quantity,  ///< position, velocity, acceleration or jerk
  use,       ///< value as a fraction of the limit
  assumed,   ///< whether the limit is assumed, because it is not known
  recorded,  ///< whether the limit is the recording's own
  distance,
  clearance,  ///< distance that must be kept
  depth,      ///< length of a translation along `normal` that separates two bodies
  normal,     ///< unit vector
  angle,
  change,
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
  joints,      ///< number of the arm's coordinates
  conditions,  ///< number of the task's rows, if it is larger than `joints`
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
  in_millimetres,  ///< whether the position is probably in millimetres
  in_degrees,      ///< whether the joint value is probably in degrees
};
std::string name(ReasonField field);
ReasonField reason_field_named(std::string_view name);  ///< throws Error for another name

using ReasonValue = std::variant<bool, std::size_t, double, std::string, Eigen::Vector3d, Ending>;

/// Returns false, 0, "" or the like: a value of the type that the field has in every reason.
ReasonValue default_value(ReasonField field);

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
