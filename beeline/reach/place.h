#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/collision/collision_model.h>
#include <beeline/error.h>
#include <beeline/planning/move_along.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Why configurations and motions must not be given while the arm stands at one mount; empty
/// functions have no reason.
struct BlockedAtMount {
  std::function<Reason(const ConfigurationRef&)> configuration = {};
  BlockedMotions motions = {};
};

/// Returns PlacementOptions::blocked_by for a model of the map's arm, whose obstacles stay while
/// the arm moves: base_blocked_by() of its with_mount() or, if link 0 can stand there, blocked_by()
/// and prove_clearance(). The model must outlive the function.
std::function<BlockedAtMount(const Pose&)> blocked_at_mounts(const CollisionModel& model);

/// The mounts that are searched: a grid of positions, each with rotations about the world's z axis.
struct PlacementOptions {
  /// Corner of the box of the mount's positions, m, in the world of the poses. Default: the box in
  /// x and y from which all poses are within reach, with z = 0.
  std::optional<Vector3> lower = std::nullopt;
  std::optional<Vector3> upper = std::nullopt;  ///< the opposite corner, m
  /// Distance between positions, m; default: edge of the map's cells.
  std::optional<double> step = std::nullopt;
  int headings = 12;  ///< number of rotations about z in equal steps, 1 to 360
  int count = 10;     ///< number of placements to return, 1 to 1000
  /// Max number of mounts that are checked, in the order of the map's ranking; at least 1.
  int max_checked = 20'000;
  /// Whether the tool must be able to move in straight lines through the poses, one after the
  /// other. The search ends after ten times `count` mounts, at least 100, without such lines.
  bool lines = false;
  /// Returns what blocks the arm at a mount, world_T_mount, in the world of the poses (in Python
  /// the CollisionModel of the map's arm, whose obstacles stay while the arm moves). Asked for each
  /// mount from which all poses are reached, from many threads: blocked solutions do not count, and
  /// blocked lines are none. Default: nothing.
  std::function<BlockedAtMount(const Pose&)> blocked_by = {};
  int threads = 0;  ///< number of threads; 0: one for each core. The result does not depend on it.
  Budget budget = {};  ///< budget; a unit of its work is one pose
};

/// A mount of the arm from which it reaches all poses.
struct Placement {
  Pose world_T_mount = Pose::Identity();  ///< pose of the mount, as with_mount() takes it
  double heading = 0;                     ///< rotation about z, rad, from 0 to 2 pi
  double margin = 0;  ///< smallest margin to the joint limits over all poses, at `solutions`
  double manipulability = 0;  ///< smallest manipulability over all poses, at `solutions`
  /// Configuration with the largest margin for each pose.
  std::vector<Configuration> solutions = {};
  double duration = 0;  ///< duration of the lines, s; 0 without the option `lines`
};

/// Result of find_placements().
struct PlacementResult {
  /// The best heading of each position, by decreasing margin, then manipulability.
  std::vector<Placement> placements = {};
  std::int64_t mounts = 0;    ///< number of mounts of the grid
  std::int64_t checked = 0;   ///< number of mounts checked by inverse kinematics at every pose
  std::int64_t reaching = 0;  ///< number of checked mounts from which all poses are reached
  /// Number of these mounts at which all solutions of some pose are blocked.
  std::int64_t blocked = 0;
  Reason blocked_reason = {};        ///< a solution's at the first of them by the map's ranking
  std::int64_t without_lines = 0;    ///< number of the others refused because of the lines
  std::int64_t blocked_lines = 0;    ///< number of these whose lines the arm could follow unblocked
  Ending ending = Ending::complete;  ///< whether the budget ended the search

  /// Whether there is a placement.
  explicit operator bool() const { return !placements.empty(); }
};

/// Returns the reason why there is no placement or the search ended early, one clause; empty
/// otherwise.
Reason reason_of(const PlacementResult& result);

/// Finds mounts from which the arm of a map reaches all poses (world_T_tool). The map ranks the
/// mounts: by the number of poses whose cells are reached, then by the least margin of these cells.
/// Each placement is checked by the inverse kinematics of the poses themselves. Throws Error for a
/// map of a scene, which would move with the mount, one with one orientation, an incomplete one,
/// one of more than 5e8 cells, no poses, an option out of its range, and more than 1e8 mounts.
PlacementResult find_placements(const ReachMap& map, std::span<const Pose> world_T_tool,
                                const PlacementOptions& options = {});

}  // namespace beeline
