#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include <beeline/budget.h>
#include <beeline/certificate/clearance.h>
#include <beeline/collision/collision_model.h>
#include <beeline/error.h>
#include <beeline/planning/branch.h>
#include <beeline/timing/retime.h>

namespace beeline {

struct FreePathOptions {
  std::uint64_t random_seed = 1;  ///< seed of the configurations that the search draws
  /// Max number of straight joint motions that the search examines, shortcuts aside, 1 or more.
  int max_edges = 50'000;
  int shortcuts = 100;  ///< number of shortcuts that are tried on the path, 0 to a million
  /// Eight samples of a straight joint motion, and a part of it that is proved, are a unit of work.
  /// A path that was found before the budget ended is returned if some further 10,000 units prove
  /// it.
  Budget budget = {};
};

/// A path of straight joint motions.
struct FreePath {
  MotionStatus status = MotionStatus::not_found;
  Reason reason = {};  ///< why there is none; none if reached
  /// Configurations from the start to a goal, (N,). Each straight joint motion from one to the next
  /// is proved to keep the clearance of the model; see prove_clearance().
  std::vector<Configuration> waypoints = {};
  std::size_t goal = 0;   ///< index of the goal that is reached
  double length = 0;      ///< sum of the distances between waypoints, the norm of their difference
  std::size_t edges = 0;  ///< number of straight joint motions that were sampled

  /// Returns whether a goal is reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
};

/// Prints the status with its reason, or the number of waypoints and the length.
std::ostream& operator<<(std::ostream& out, const FreePath& path);

/// Searches a path in joint space, from a configuration to one of the goals, that keeps the
/// clearance of the model: the straight joint motions to the goals first, then, unless the nearest
/// goal is reached, two trees of random configurations that grow towards each other from both ends
/// (RRT-Connect, Kuffner and LaValle 2000), to the near goals first. The trees use edges of which
/// no sample is blocked; the path is shortened, and each of its motions is proved. An edge that is
/// not proved is removed, and the search goes on. A path of more than 2.5 times the distance to the
/// nearest free goal is searched again, up to four times with at most 1000 edges each. The shortest
/// path that is found is returned. Equal arguments give equal paths. Joint values are numbers;
/// angles are not wrapped. Lengths of paths add radians and metres.
///
/// The status is `outside_limits` for a start or goals outside the position limits, and `collides`
/// or `not_decided` for a start or goals that are not proved to keep the clearance; the reason
/// names the two bodies. It is `not_found` if the trees do not meet: there may be a path
/// nevertheless.
///
/// Throws Error for configurations that do not fit the arm, for no goals, and for options out of
/// their range.
FreePath find_free_path(const CollisionModel& model, const Configuration& start,
                        std::span<const Configuration> goals, const FreePathOptions& options = {});

struct FreeMotionOptions {
  std::uint64_t random_seed = 1;  ///< see FreePathOptions
  int max_edges = 50'000;         ///< see FreePathOptions
  int shortcuts = 100;            ///< see FreePathOptions
  /// Largest distance from a waypoint, the norm of the difference, at which the motion leaves the
  /// straight line to pass it without a stop; 0: the arm stops at each waypoint.
  double joint_blend = Limits::none;
  /// Profile of the time scaling from stop to stop; default: `jerk`. See RetimeOptions.
  std::optional<Profile> profile = std::nullopt;
  Interpolation interpolation = Interpolation::quintic;  ///< interpolation of the trajectory
  double speed_scale = 1;                                ///< see RetimeOptions
  double tool_speed = Limits::none;  ///< limit of the tool origin's speed, m/s, 1e-8 or more
  /// Samples per second, at times k / rate. 0: as many as the interpolation needs.
  double rate = 0;
  /// Duration to which the quickest motion is slowed down, s, without a rate; default: the
  /// shortest.
  std::optional<double> duration = std::nullopt;
  int max_samples = default_max_samples;  ///< max samples of the motion, 2 or more
  /// Largest depth from which the motion may lead out of the clearance, m, see
  /// ClearanceOptions::recover_clearance.
  double recover_clearance = 0;
  Budget budget = {};  ///< budget of search, timing and proof
};

/// A motion from rest to rest that keeps the clearance of a model.
struct FreeMotion {
  MotionStatus status = MotionStatus::not_found;
  Reason reason = {};          ///< why there is none; none if reached
  Trajectory trajectory = {};  ///< motion; empty unless reached
  /// The path that was found. With a recovery its first motion, which leads out of the clearance,
  /// is added to it, and the arm stops after it.
  FreePath path = {};
  std::vector<double> blends = {};  ///< radius of the blend at each inner waypoint; 0: a stop
  ClearanceProof clearance = {};    ///< proof for the trajectory, with the recovery
  LimitUsage limits = {};           ///< fractions of the limits that the trajectory uses

  /// Returns whether a goal is reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Prints the status with its reason, or the duration, the samples and the proof.
std::ostream& operator<<(std::ostream& out, const FreeMotion& motion);

/// Plans a motion to one of the goals that keeps the clearance of the model: the path of
/// find_free_path(), with a blend at each inner waypoint, in minimum time as retime() does. The
/// finished trajectory is proved by prove_clearance(). A blend that is not proved is made smaller,
/// down to a stop; if the finished trajectory is not, the arm stops at each waypoint. From a start
/// that is closer than the clearance, by options.recover_clearance or less, the path begins with a
/// straight joint motion out of it, which is searched by descent. The status and the reason are as
/// of find_free_path(), prove_clearance() and retime(). Throws Error where these do, and for a
/// joint_blend below 0.
FreeMotion move_around(const CollisionModel& model, const Configuration& start,
                       std::span<const Configuration> goals, const FreeMotionOptions& options = {});

}  // namespace beeline
