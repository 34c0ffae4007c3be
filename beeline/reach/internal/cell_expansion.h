#pragma once

#include <optional>

#include <beeline/reach/internal/branch_solver.h>

namespace beeline::internal {

/// Computes the cells of all azimuths and rolls from the branches of one. Not thread-safe.
///
/// In a singular configuration the arm has infinitely many solutions, of which a branch is one: the
/// cells of singular branches are solved one by one.
class CellExpansion {
 public:
  CellExpansion(const Arm& arm, const ReachGrid& grid, const FreeJoints& free,
                int redundant_values);

  /// Computes the cells of the positions from `first` to `last` into `cells`, whose first cell is
  /// the first one of position `origin`. The first cell of `branches` belongs to position `solved`,
  /// counted without azimuths.
  void expand(const ReachBranches& branches, Eigen::Index solved, Eigen::Index first,
              Eigen::Index last, Eigen::Index origin, ReachCells& cells);

  /// Adds to `counts` the number of reached cells of each position, azimuths the fastest, without
  /// computing the cells. Position numbers do not include azimuths: `branches` begins at position
  /// `solved`, and the positions from solved + first to solved + last (exclusive) are counted.
  void count_reached(const ReachBranches& branches, Eigen::Index solved, Eigen::Index first,
                     Eigen::Index last, std::vector<Eigen::Index>& counts);

 private:
  /// Whether a cell has a branch at which the arm is singular and an angle of it matters.
  bool singular(const ReachBranches& branches, std::size_t cell) const;
  /// Writes the margins of a branch's free joints at the azimuths from `begin` to `end` and at each
  /// roll; negative where they are outside their limits.
  void turn(const ReachBranches& branches, std::size_t branch, Eigen::Index begin,
            Eigen::Index end);
  /// The branches of one cell of the grid, with all its limits.
  ReachBranches solve_once(Eigen::Index cell);
  void solve_cell(Eigen::Index cell, Eigen::Index target, ReachCells& cells);

  Arm arm_;
  ReachGrid grid_;
  FreeJoints free_;
  float singular_;  ///< manipulability
  int redundant_values_;
  std::optional<BranchSolver> one_by_one_;  ///< made by the first singular cell
  std::vector<double> azimuths_, rolls_;    ///< the angles, rad
  std::vector<float> azimuth_margins_, roll_margins_;
};

}  // namespace beeline::internal
