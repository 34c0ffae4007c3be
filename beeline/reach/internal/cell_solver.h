#pragma once

#include <optional>
#include <vector>

#include <beeline/reach/internal/pose_solver.h>
#include <beeline/reach/internal/roll_joint.h>
#include <beeline/reach/reach.h>

namespace beeline::internal {

/// Computes the cells of positions. Not thread-safe: each thread has a copy.
///
/// Where the last joint rolls the tool (RollJoint), the solutions of one roll, with that joint
/// free, give those of all others: its value moves by the roll, and is compared with its limits.
class CellSolver {
 public:
  /// Throws Error as reach_cells() does.
  CellSolver(const Arm& arm, const ReachGrid& grid, int redundant_values);

  /// Computes the cells of the positions from `first` to `last` into `cells`, whose first cell is
  /// the first one of position `origin`.
  void solve(Eigen::Index first, Eigen::Index last, Eigen::Index origin, ReachCells& cells);

 private:
  void solve_direction(Eigen::Index p, Eigen::Index d, Eigen::Index target, ReachCells& cells);
  /// Adds the solutions of solver_, their last joint turned by the roll, to a cell.
  void add_turned(double roll, Eigen::Index target, ReachCells& cells);
  /// Writes the best measures of all solutions that were added.
  void measure(ReachCells& cells);

  Arm arm_;
  ReachGrid grid_;
  Task rows_;                          ///< of the manipulability
  std::optional<RollJoint> roll_;      ///< where the solutions of one roll give those of all
  bool any_roll_;                      ///< whether each cell has any roll
  PoseSolver solver_;                  ///< of the arm, with its last joint free where roll_ is used
  std::vector<double> solutions_;      ///< those added, one after the other
  std::vector<Eigen::Index> targets_;  ///< the cell of each
};

}  // namespace beeline::internal
