#include <utility>

#include <beeline/reach/internal/branch_solver.h>
#include <beeline/reach/internal/solution_measures.h>

namespace beeline::internal {

BranchSolver::BranchSolver(const Arm& arm, const FreeJoints& free, int redundant_values,
                           BlockedBy blocked_by)
    : arm_(arm),
      free_(free),
      solver_(with_free_joints(arm, free), redundant_values, std::move(blocked_by)) {}

void BranchSolver::solve(const Pose& world_T_tool) {
  solver_.solve(world_T_tool);
  const auto found = solver_.solutions();
  for (Eigen::Index i = 0; i < found.cols(); ++i) {
    solutions_.insert(solutions_.end(), found.col(i).begin(), found.col(i).end());
    branches_.first_joint.push_back(found(0, i));
    branches_.last_joint.push_back(found(found.rows() - 1, i));
  }
  branches_.ends.push_back(branches_.first_joint.size());
  branches_.counts.push_back(static_cast<std::uint8_t>(solver_.branches()));
}

void BranchSolver::solve(const ReachGrid& grid, Eigen::Index first, Eigen::Index last) {
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  const Eigen::Index apart = at_position / free_.solved_orientations(grid);
  for (Eigen::Index s = first; s < last; ++s) {
    const Eigen::Index cell = s * grid.azimuths() * at_position;
    for (Eigen::Index k = 0; k < at_position; k += apart) solve(grid.pose(cell + k));
  }
}

ReachBranches BranchSolver::take() {
  const auto count = static_cast<Eigen::Index>(branches_.first_joint.size());
  const Eigen::Map<const Eigen::MatrixXd> q(solutions_.data(), arm_.dof(), count);
  const int begin = free_.base ? 1 : 0, end = arm_.dof() - (free_.roll ? 1 : 0);
  SolutionMeasures measures = solution_measures(arm_, q, begin, end);
  branches_.manipulability = std::move(measures.manipulability);
  branches_.margin = std::move(measures.margin);
  solutions_.clear();
  return std::exchange(branches_, {});
}

}  // namespace beeline::internal
