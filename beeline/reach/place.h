#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Where an arm may stand: on a grid of positions, turned about the world's z axis.
struct PlacementOptions {
  /// Corner of the box of the mount's positions, m, in the world of the poses. Default: in x and y
  /// where all poses are within reach, z = 0.
  std::optional<Vector3> lower = std::nullopt;
  std::optional<Vector3> upper = std::nullopt;  ///< the opposite corner, m
  std::optional<double> step = std::nullopt;    ///< between positions, m; default: the map's cells
  int headings = 12;                            ///< rotations about z in equal steps, 1 to 360
  int count = 10;                               ///< placements to return, 1 to 1000
  /// Mounts that are checked, those first which the map ranks first; at least 1.
  int max_checked = 20'000;
  /// Only placements from which the tool can move in straight lines through the poses, one after
  /// the other. The search ends after ten times `count` mounts, at least 100, without.
  bool lines = false;
  int threads = 0;     ///< 0: one for each core. The result does not depend on it.
  Budget budget = {};  ///< a unit of its work is one pose
};

/// A mount of the arm from which it reaches all poses.
struct Placement {
  Pose world_T_mount = Pose::Identity();  ///< pose of the mount, as with_mount() takes it
  double heading = 0;                     ///< rotation about z, rad, from 0 to 2 pi
  double margin = 0;          ///< least margin to the joint limits over all poses, at `solutions`
  double manipulability = 0;  ///< least manipulability over all poses, at `solutions`
  /// Of each pose, the configuration with the largest margin.
  std::vector<Configuration> solutions = {};
  double duration = 0;  ///< of the lines, s; 0 without the option `lines`
};

/// Where an arm can stand to reach all poses.
struct PlacementResult {
  /// The largest margin first, then manipulability; of each position the best heading.
  std::vector<Placement> placements = {};
  std::int64_t mounts = 0;           ///< of the grid
  std::int64_t checked = 0;          ///< of these, by inverse kinematics at every pose
  std::int64_t reaching = 0;         ///< of these, all poses reached
  std::int64_t without_lines = 0;    ///< of these, refused because of the lines
  Ending ending = Ending::complete;  ///< whether the budget ended the search

  /// Whether there is a placement.
  explicit operator bool() const { return !placements.empty(); }
};

/// Why there is no placement, or why the search ended early, one clause; empty otherwise.
Reason reason_of(const PlacementResult& result);

/// Finds mounts from which the arm of a map reaches all poses (world_T_tool). The map ranks the
/// mounts: by the number of poses whose cells are reached, then by the least margin of these cells.
/// Each placement is checked by the inverse kinematics of the poses themselves. Throws Error for a
/// map with one orientation, an incomplete one, one of more than 5e8 cells, no poses, an option out
/// of its range, and more than 1e8 mounts.
PlacementResult find_placements(const ReachMap& map, std::span<const Pose> world_T_tool,
                                const PlacementOptions& options = {});

}  // namespace beeline
