#pragma once

#include <cstdint>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/reach/grid.h>

namespace beeline {

/// The largest number of samples of a map by sampling.
constexpr std::int64_t max_samples = 1'000'000'000'000;

struct ReachOptions {
  /// Above 0, by sampling: a cell is reached if the tool is in it with one of so many
  /// configurations, which fill the joint ranges evenly. Otherwise by inverse kinematics.
  std::int64_t samples = 0;
  /// Values of the redundant joint at which all solutions of an arm of seven joints are computed,
  /// 1 to 1000: equal steps over its range. Where there is none, the range between them is
  /// searched. Branches, manipulability and margin are the best of those solutions.
  int redundant_values = 16;
  int threads = 0;  ///< 0: one for each core. The results do not depend on it.
  /// A unit of its work is one cell, or one sample. Reports the fraction computed, from any thread.
  Budget budget = {};
};

/// What an arm can do at the centres of cells, each with all solutions of the inverse kinematics
/// within the joint limits, counted modulo 2 pi; by sampling, anywhere in a cell, with the samples
/// that are in it. One value for each cell.
struct ReachCells {
  /// The number of solutions, 0 for a pose that is not reached. A redundant arm: the largest number
  /// at one value of its redundant joint; 1 where the arm has no closed form and one was found;
  /// some of infinitely many in a singular configuration. By sampling, the samples in the cell, at
  /// most 255.
  std::vector<std::uint8_t> branches;
  /// The largest manipulability of a solution: sqrt(det(J J^T)) of the task's rows, metres and
  /// radians (manipulability_measures()). Of an arm with fewer joints, the rows of the position, of
  /// a SCARA those and the rotation about z; with fewer than these, sqrt(det(J^T J)). NaN where the
  /// pose is not reached.
  std::vector<float> manipulability;
  /// The largest margin of a solution to the joint limits: 1 in the middle of all ranges, 0 on a
  /// limit (limit_margin()); joints without limits do not count. NaN where the pose is not reached.
  std::vector<float> margin;
  Ending ending = Ending::complete;  ///< unless complete, the cells are not to be used

  void resize(std::size_t cells);
};

/// Computes the cells of the positions from `first` to `last` (exclusive) of the grid. If any roll
/// is accepted (ReachOrientations::directions), the roll counts as reached if some value of the
/// last joint reaches it, and the margin is the smallest margin of the other joints. A pose between
/// the cells belongs to the cell ReachGrid::cell_of(). Throws Error for an arm with fewer joints
/// than a pose has components. Without rolls, throws Error for an arm whose last joint does not
/// turn about the tool's z axis. With azimuths, throws Error for an arm whose solutions cannot all
/// be computed, such as a redundant one. By sampling, throws Error for azimuths, for one
/// orientation, and for a joint without position limits that is not revolute or that others follow.
ReachCells reach_cells(const Arm& arm, const ReachGrid& grid, Eigen::Index first, Eigen::Index last,
                       const ReachOptions& options = {});

/// The best of all orientations at each position.
struct ReachPositions {
  std::vector<float> directions;       ///< fraction of the directions that are reached
  std::vector<std::uint8_t> branches;  ///< largest number of solutions, as in ReachCells
  std::vector<float> manipulability;   ///< the largest; NaN: not reached
  std::vector<float> margin;           ///< the largest, as in ReachCells; NaN: not reached
};

/// Summarises cells of whole positions. A direction is reached if it is with some roll.
ReachPositions reach_positions(const ReachGrid& grid, const ReachCells& cells);

}  // namespace beeline
