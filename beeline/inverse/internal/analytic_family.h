#pragma once

#include <optional>
#include <string>

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Analytic inverse kinematics of a family of arms. The table of families is in
/// analytic_families.cpp.
struct AnalyticFamily {
  /// Whether the family covers the arm and the task. If so, sets the members of the state that the
  /// other functions need. With options.lock, a family applies only if the locked coordinate's
  /// value is an input of its formulas.
  bool (*applies)(SolverState& state);

  /// Such as `three axes meet (joints 4, 5, 6)`.
  std::string (*name)(const SolverState& state);

  /// Adds solutions, by CandidateSolutions. Sets evidence().complete to false where solutions may
  /// be missing, and evidence().branches_complete where a whole branch may be.
  void (*solve)(SolverState& state, const Request& request, StageResult& found);

  /// For control loops, or null: writes the solutions nearest to the seed, as many as fit, and
  /// returns their number; nothing if the request needs solve(). Does not allocate.
  std::optional<int> (*solve_fast)(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed, BudgetMeter& budget,
                                   Eigen::Ref<Eigen::MatrixXd> solutions) = nullptr;

  /// For one solution the numerical stage is faster: the family then runs only if that finds none.
  bool slower_than_search = false;
};

/// Whether an arm has so many coordinates, each that of one revolute joint, and the task all rows.
bool has_revolute_joints(const SolverState& state, int count);

/// Planar arms of one to three joints: planar_solver.h.
extern const AnalyticFamily planar_family;

/// Arms and tasks that PieperSolver covers: three axes of the closed loop meet or are parallel.
extern const AnalyticFamily pieper_family;

/// Arms of seven revolute joints, of which six remain with a closed form when one is locked. Only
/// for all solutions, and for InverseMethod::closed_form: those on a grid of values of that joint.
extern const AnalyticFamily locked_joint_family;

/// Six revolute joints of any geometry: raghavan_roth_solver.h.
extern const AnalyticFamily raghavan_roth_family;

}  // namespace beeline::internal
