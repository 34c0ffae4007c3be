#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/internal/tool_volume.h>
#include <beeline/inverse/inverse_kinematics.h>

namespace beeline::internal {

/// ReachOptions::blocked_by.
using BlockedBy = std::function<Reason(const ConfigurationRef&)>;

/// All solutions of poses of one arm. Not thread-safe: each thread has a copy.
class PoseSolver {
 public:
  /// `redundant_values`, `blocked_by`: see ReachOptions.
  PoseSolver(const Arm& arm, int redundant_values, BlockedBy blocked_by = {});

  /// Finds the free solutions within limits. They are complete for an arm without a redundant
  /// joint; of infinitely many at a pose, the one of each branch that is nearest to the middle of
  /// the limits and, if these are blocked, one of others. For an arm with a redundant joint they
  /// are the solutions at each of its values; if solutions exist only between these values, one is
  /// found.
  void solve(const Pose& world_T_tool);

  /// The solutions, one in each column; angles are the equivalent ones nearest to the middle of the
  /// limits. A reference that the next solve() invalidates.
  auto solutions() const { return found_.leftCols(count_); }
  int branches() const { return branches_; }  ///< see ReachCells
  /// The reason of the last solution of the pose that is blocked; none if all are free.
  const Reason& blocked() const { return blocked_; }

 private:
  /// Counts the solutions from column `first` on, found together, and keeps those that are free.
  void keep_free(Eigen::Index first);
  void add_all(const Pose& world_T_tool, const InverseOptions& options);
  /// Adds the branches within limits at a value of the redundant joint.
  void add_branches(const Pose& world_T_tool, double value);
  bool is_new(const ConfigurationRef& q, Eigen::Index first) const;

  Arm arm_;
  InverseOptions any_;  ///< for one solution
  /// For one that is free; slower where there is none. Only if solutions can be blocked.
  InverseOptions any_free_;
  std::optional<InverseOptions> all_;  ///< for all solutions, if the arm has a closed form;
  std::optional<int> redundant_;       ///< then with this coordinate locked
  std::vector<double> values_;         ///< at each of these
  /// The closed form of three axes that meet, which takes the value of the redundant joint.
  std::optional<PieperSolver> form_;
  PieperRequest loop_;
  ToolVolume volume_;
  Configuration seed_;
  Eigen::MatrixXd found_;
  Eigen::Index count_ = 0;
  BlockedBy blocked_by_;
  Reason blocked_ = {};
  bool has_solution_ = false;  ///< free or not
  int branches_ = 0;
};

}  // namespace beeline::internal
