#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/reach/grid.h>
#include <beeline/reason.h>

namespace beeline {

/// The largest number of samples of a map by sampling.
constexpr std::int64_t max_samples = 1'000'000'000'000;

/// The scene in which solutions of a map are free, as its file identifies it.
struct ReachScene {
  std::string digest = {};              ///< digest() of the CollisionModel
  double clearance = 0;                 ///< distance to keep, m; obstacles may have their own
  std::vector<std::string> files = {};  ///< paths of its files, for reports
};

struct ReachOptions {
  /// Number of configurations of a map by sampling, which fill the joint ranges evenly: a cell is
  /// reached if the tool is in it with one of them. 0: by inverse kinematics.
  std::int64_t samples = 0;
  /// Number of values of the redundant joint, 1 to 1000, in equal steps over its range. All
  /// solutions of an arm of seven joints are computed at each. If none has a solution, the ranges
  /// between them are searched. Branches, manipulability and margin are the best of all solutions.
  int redundant_values = 16;
  /// Reason why a configuration must not count as a solution, none if it may; usually blocked_by()
  /// of a CollisionModel of the same arm (in Python the model). Branches, manipulability and margin
  /// are of solutions without a reason; a sample with one is left out. For an arm of seven joints,
  /// the ranges between the values of the redundant joint are not searched where a value has a
  /// solution, free or not. Called from many threads. Default: every solution counts.
  std::function<Reason(const ConfigurationRef&)> blocked_by = {};
  /// The scene of `blocked_by`. Files of maps need it, because parts of another one are refused.
  std::optional<ReachScene> scene = std::nullopt;
  int threads = 0;  ///< number of threads; 0: one for each core. The results do not depend on it.
  /// A unit of its work is one cell, or one sample. Reports the fraction computed, from any thread.
  Budget budget = {};
};

/// Reachability and manipulability at the centres of cells, computed from all solutions of the
/// inverse kinematics within the joint limits, counted modulo 2 pi. By sampling, they are computed
/// from the samples anywhere in the cell. One value for each cell.
struct ReachCells {
  /// The number of solutions, 0 for a pose that is not reached. For a redundant arm it is the
  /// largest number at one value of its redundant joint, or 1 if the arm has no closed form and a
  /// solution was found. In a singular configuration it counts some of infinitely many. By
  /// sampling, it is the number of samples in the cell, at most 255.
  std::vector<std::uint8_t> branches;
  /// The largest manipulability of a solution: sqrt(det(J J^T)) of the task's rows, metres and
  /// radians (manipulability_measures()). An arm with fewer joints than rows has the rows of the
  /// position, and a SCARA also the rotation about z; with fewer joints than these rows, it is
  /// sqrt(det(J^T J)). NaN if the pose is not reached.
  std::vector<float> manipulability;
  /// The largest margin of a solution to the joint limits: 1 in the middle of all ranges, 0 on a
  /// limit (limit_margin()); joints without limits are ignored. NaN if the pose is not reached.
  std::vector<float> margin;
  Ending ending = Ending::complete;  ///< unless complete, the cells must not be used

  void resize(std::size_t cells);
};

/// Computes the cells of the positions from `first` to `last` (exclusive) of the grid. If any roll
/// is accepted (ReachOrientations::directions), the roll counts as reached if some value of the
/// last joint reaches it, and the margin is the smallest margin of the other joints. A pose between
/// the cells belongs to the cell ReachGrid::cell_of(). Throws Error for an arm with fewer joints
/// than a pose has components. Without rolls, throws Error for an arm whose last joint does not
/// turn about the tool's z axis. With blocked_by, throws Error without rolls, because the last
/// joint moves the bodies on the last link, and for azimuths, because a scene is not the same from
/// each of them; neither by sampling without rolls. With azimuths, throws Error for an arm whose
/// solutions cannot all be computed, such as a redundant one. By sampling, throws Error for
/// azimuths, for one orientation, and for a joint without position limits that is not revolute or
/// that others follow.
ReachCells reach_cells(const Arm& arm, const ReachGrid& grid, Eigen::Index first, Eigen::Index last,
                       const ReachOptions& options = {});

/// The best of all orientations at each position.
struct ReachPositions {
  std::vector<float> directions;       ///< fraction of the directions that are reached
  std::vector<std::uint8_t> branches;  ///< largest number of solutions, as in ReachCells
  std::vector<float> manipulability;   ///< largest manipulability; NaN if not reached
  std::vector<float> margin;           ///< largest margin, as in ReachCells; NaN if not reached
};

/// Summarises cells of whole positions. A direction is reached if it is reached with some roll.
ReachPositions reach_positions(const ReachGrid& grid, const ReachCells& cells);

}  // namespace beeline
