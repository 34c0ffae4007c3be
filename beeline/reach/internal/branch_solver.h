#pragma once

#include <vector>

#include <beeline/reach/internal/branches.h>
#include <beeline/reach/internal/pose_solver.h>

namespace beeline::internal {

/// Finds the solutions of poses with the joints free that FreeJoints names, and measures them many
/// at a time. Not thread-safe: each thread has a copy.
class BranchSolver {
 public:
  /// `redundant_values`, `blocked_by`: see ReachOptions. With joints that are free, nothing can be
  /// blocked: free_joints() has none in a scene.
  BranchSolver(const Arm& arm, const FreeJoints& free, int redundant_values,
               BlockedBy blocked_by = {});

  /// Adds a cell with the solutions of a pose.
  void solve(const Pose& world_T_tool);
  /// Adds the branches of the positions from `first` to `last` (exclusive), counted without
  /// azimuths.
  void solve(const ReachGrid& grid, Eigen::Index first, Eigen::Index last);
  /// Returns the cells that were added since the last call.
  ReachBranches take();

 private:
  Arm arm_;
  FreeJoints free_;
  PoseSolver solver_;
  ReachBranches branches_;
  std::vector<double> solutions_;  ///< of all branches, one configuration after the other
};

}  // namespace beeline::internal
