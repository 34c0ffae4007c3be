#pragma once

#include <functional>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/certificate/clearance.h>
#include <beeline/certificate/verify.h>
#include <beeline/collision/collision_model.h>
#include <beeline/error.h>
#include <beeline/planning/branch.h>
#include <beeline/timing/retime.h>

namespace beeline {

/// A path that the arm can follow in place of one that it cannot: the original path after a
/// translation or rotation, or the original path from another start.
struct NearbyPath {
  Vector3 translation = Vector3::Zero();  ///< translation of the path, m, in world axes
  Vector3 rotation = Vector3::Zero();     ///< rotation vector of each pose, rad, in tool axes
  ToolPath path;                          ///< the path after the translation or rotation
  /// Start that replaces the given one; std::nullopt if the given start is kept.
  std::optional<Configuration> start = std::nullopt;
  /// The change in words, such as `with every waypoint moved by 0.012 m along -z; the start stays`.
  std::string description;
};

/// Searches for the shortest translation with which plan_path() succeeds, along one of the world's
/// axes or half-way between several of them. If `rotate`, searches for the smallest rotation of the
/// tool about its own axes or about directions half-way between them. Sizes quadruple from 4 mm to
/// 0.256 m, or from 0.01 to 0.64 rad; bisection refines the size in the directions that succeed
/// first. Each size is first searched coarsely, within a limit of work. Paths of planar arms move
/// in the plane. With a start, the path's first pose is kept and its first line leads to the moved
/// path; there is no result if the path's first segment is not a line or continues smoothly. If the
/// budget ends the search, the result is empty or not refined. Throws Error as plan_path() does.
std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool rotate);

/// What blocks motions along a path.
struct BlockedMotions {
  /// Reason against a planned motion, within options.budget; none if it is not blocked. The motion
  /// may begin closer than the clearance by options.recover_clearance.
  std::function<Reason(const Trajectory&, const ClearanceOptions& options)> reason = {};
  /// Distance beyond the clearance at a configuration, m, negative where it is blocked. Redundant
  /// arms keep it positive by self-motion if the best motion is blocked. Default: unknown.
  std::function<double(const ConfigurationRef&)> spare_clearance = {};
};

/// Returns the motions that do not keep the clearance of a model: a shared one, or one that
/// outlives the result.
BlockedMotions blocked_motions(const std::shared_ptr<const CollisionModel>& model);
BlockedMotions blocked_motions(const CollisionModel& model);

struct PathMotionOptions {
  /// Rows that matter; default: planar for a planar arm, whose path must then be in its plane, else
  /// spatial. Lines allow any task; other segments need all orientation rows or none, and position
  /// rows in Frame::base, the world's axes.
  std::optional<Task> task = std::nullopt;
  double tolerance = 1e-4;              ///< max deviation in position, metres, 1e-8 or more
  double orientation_tolerance = 1e-4;  ///< max deviation in orientation, radians, 1e-8 or more
  /// Profile of the time scaling from stop to stop; default: `jerk`. Every profile keeps known jerk
  /// limits; `fastest` and `trapezoidal` do not limit an unknown jerk.
  std::optional<Profile> profile = std::nullopt;
  Interpolation interpolation = Interpolation::quintic;  ///< interpolation of the trajectory
  double tool_speed = Limits::none;  ///< limit of the tool origin's speed, m/s, 1e-8 or more
  /// Samples per second, 0 or at least 0.001. The samples are at k / rate, and each section from
  /// stop to stop lasts a whole number of periods. 0: as many samples as interpolation and
  /// tolerance need.
  double rate = 0;
  /// Duration to which the quickest motion is slowed down, s, without a rate; default: the
  /// shortest.
  std::optional<double> duration = std::nullopt;
  /// Max samples of the whole path, 2 or more; beyond it `too_many_samples`.
  int max_samples = default_max_samples;
  /// Largest excess of the start over a position limit, 0 to 0.1 rad or m, from which the motion
  /// recovers: a first section leads straight in joint space, from rest to rest, to the nearest
  /// configuration within the limits (nearest_within_limits()), where the path begins.
  double recover = 0;
  /// Motions that must not be given, as in a scene (in Python the CollisionModel). If the best one
  /// is blocked, the other branches are planned and, if the arm is redundant, other self-motions,
  /// and the best motion that is not blocked is given. PathMotion::blocked lists the others.
  /// Default: every motion may be given.
  BlockedMotions blocked_by = {};
  /// Largest depth from which a motion from a given start may lead out of the clearance of
  /// `blocked_by`, m: ClearanceOptions::recover_clearance. The path itself must lead out;
  /// nearby paths are not suggested from such a start.
  double recover_clearance = 0;
  /// Whether to search for nearby paths if the path cannot be followed or its motions are blocked.
  bool suggest = false;
  Budget budget = {};  ///< budget of the plan, its timing, its proof and the suggestions
};

/// A branch that is not given: PathMotionOptions::blocked_by has a reason against its motion, or it
/// ends before the path does.
struct BlockedBranch {
  Configuration start;                           ///< configuration at the path's beginning, (n,)
  MotionStatus status = MotionStatus::collides;  ///< collides, not_decided, or why it ends
  Reason reason = {};                            ///< why, with the time or the place
  double path_parameter = 0;                     ///< path parameter up to which it follows the path
};

/// A trajectory along a path, with its proof. Only status, reason, path_parameter, nearby and
/// blocked are set unless reached: the bound of the deviation is then infinite.
struct PathMotion {
  MotionStatus status = MotionStatus::not_found;
  Reason reason = {};              ///< why, with the position; none if reached
  double path_parameter = 0;       ///< path parameter up to which the plan follows the path
  std::vector<NearbyPath> nearby;  ///< paths that the arm can follow, with the option `suggest`
  /// With the option `blocked_by`, if the best branch has a reason: this branch and the others that
  /// are not given, best first. Of a redundant arm only those that are better than the given one.
  std::vector<BlockedBranch> blocked;
  Trajectory trajectory;                ///< trajectory from rest to rest
  ToolPath path;                        ///< the path that it follows
  std::vector<double> path_parameters;  ///< path parameter of each sample, (N,)
  /// The sample at the end of each segment of `path`, or the first after it.
  std::vector<std::size_t> arrivals;
  PathDeviation deviation;  ///< proved deviation of the finished trajectory
  LimitUsage limits;        ///< fractions of the limits that the finished trajectory uses
  /// The section that leads back within the position limits, with the option `recover`; of a motion
  /// that starts within them none. The limits and the path are proved after it.
  std::optional<Recovery> recovery = std::nullopt;
  /// Smallest distance of a joint to a position limit, as a fraction of half its range.
  double limit_margin = 0;
  /// Smallest inverse condition number of the task's Jacobian, from 0 to 1.
  double inverse_condition = 0;

  /// Whether the end was reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Prints the status with its reason, or with the duration and the proved deviation.
std::ostream& operator<<(std::ostream& out, const PathMotion& motion);

/// Max stops of a path. Each stop costs some milliseconds and 100 kB.
constexpr std::size_t max_stops = 5000;

/// Moves the tool along a path, at rest where the route stops. A waypoint is a segment's end.
///
/// - Samples are within joint limits, and off the path by about a hundredth of the tolerance at
/// most.
/// - verify() proves that the tool moves along the whole path within the tolerance at all times of
///   the motion that the trajectory's columns mean (see Interpolation), with the times as files
///   hold them. Hence no change of branch can occur, and `beeline check` passes the file.
/// - Starts at `start`, whose tool must be at the path's beginning, or at the best configuration
///   there; redundancy is resolved for the whole path (plan_path()).
/// - The duration is the shortest that the profile and the joint limits allow, or
///   options.duration; a duration that is too short has the status outside_limits. Unknown limits
///   are assumed (motion_limits()).
///
/// - With options.recover the motion may begin with a recovery. verify() proves, with the same
///   option, that no joint moves out in it; options.blocked_by counts for it too.
/// - With options.recover_clearance the motion may begin closer than the clearance, which
///   prove_clearance() proves with the same option.
///
/// Throws Error for a start outside the limits or with the tool elsewhere, an option out of range,
/// a route without segments or with more than max_stops stops, and a task that its segments do not
/// allow.
PathMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const PathMotionOptions& options = {});

/// Moves the tool in straight lines from its pose at `start` through the waypoints (world_T_tool),
/// at rest at each; arrivals[i] belongs to waypoints[i]. Orientations follow the shortest rotation.
PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options = {});
PathMotion move_in_lines(const Arm& arm, const Configuration& start,
                         std::initializer_list<Pose> waypoints,
                         const PathMotionOptions& options = {});

/// The same with the joint values at the start as a list: move_in_lines(arm, {0, 1.57, 0}, {pose}).
PathMotion move_in_lines(const Arm& arm, std::initializer_list<double> start,
                         std::span<const Pose> waypoints, const PathMotionOptions& options = {});
PathMotion move_in_lines(const Arm& arm, std::initializer_list<double> start,
                         std::initializer_list<Pose> waypoints,
                         const PathMotionOptions& options = {});

/// Does the same from the first pose, with the best configuration there: arrivals[i] belongs to
/// poses[i + 1].
PathMotion move_in_lines(const Arm& arm, std::span<const Pose> poses,
                         const PathMotionOptions& options = {});
PathMotion move_in_lines(const Arm& arm, std::initializer_list<Pose> poses,
                         const PathMotionOptions& options = {});

}  // namespace beeline
