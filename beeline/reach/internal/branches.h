#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <beeline/reach/internal/turning_joint.h>
#include <beeline/reach/reach.h>

namespace beeline::internal {

/// The joints of an arm that are free while the poses of a grid are solved. The solutions of one
/// azimuth and one roll give the solutions of all others: the values of these joints change by the
/// angle. Azimuths and rolls are then interval tests against the joint limits (as in RM4D, Rudorfer
/// 2024, which assumes full turns).
struct FreeJoints {
  std::optional<TurningJoint> base = std::nullopt;  ///< of cylindrical grids
  std::optional<TurningJoint> roll =
      std::nullopt;       ///< of grids with directions, where the arm has one
  bool any_roll = false;  ///< whether each cell has any roll

  /// The orientations of a position that are solved: all, or those without their rolls.
  Eigen::Index solved_orientations(const ReachGrid& grid) const {
    return grid.directions() * (roll ? 1 : grid.rolls());
  }
};

/// Returns them; none where solutions count only if they are free `in_scene`: what is around the
/// arm is not the same at another azimuth, and the tool's bodies are not at another roll. Throws
/// Error as reach_cells() does.
FreeJoints free_joints(const Arm& arm, const ReachGrid& grid, bool in_scene);

/// The arm without the limits of those joints.
Arm with_free_joints(const Arm& arm, const FreeJoints& free);

/// The solutions of the solved cells: of positions at azimuth 0, each with its solved orientations.
struct ReachBranches {
  std::vector<std::size_t> ends = {};     ///< of the branches of each cell, one past the last
  std::vector<std::uint8_t> counts = {};  ///< of each cell: ReachCells::branches if all count
  std::vector<double> first_joint = {}, last_joint = {};  ///< of each branch: their values
  std::vector<float> manipulability = {};                 ///< of each branch
  std::vector<float> margin = {};  ///< of each branch: the least one of the joints not free
  Ending ending = Ending::complete;

  std::size_t begin(std::size_t cell) const { return cell == 0 ? 0 : ends[cell - 1]; }
  /// Appends the cells of others.
  void append(const ReachBranches& others);
};

/// Solves the positions from `first` to `last` (exclusive), counted without azimuths. A unit of the
/// budget's work is one cell of the grid.
ReachBranches reach_branches(const Arm& arm, const ReachGrid& grid, Eigen::Index first,
                             Eigen::Index last, const ReachOptions& options);

/// The positions that a thread solves at once: of about a thousand poses.
constexpr Eigen::Index block_of_positions(Eigen::Index solved_orientations) {
  return std::max<Eigen::Index>(1, 1024 / solved_orientations);
}

}  // namespace beeline::internal
