#pragma once

#include <string>

#include <beeline/inverse/internal/solutions.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Analytic inverse kinematics of a family of arms. The table of families is in
/// stages.cpp.
struct AnalyticFamily {
  /// Whether the family covers the arm and the task. If so, sets the members of the state that the
  /// other functions need. With options.lock, a family applies only if the locked coordinate's
  /// value is an input of its formulas.
  bool (*applies)(SolverState& state);

  /// Returns a description such as `three axes meet (joints 4, 5, 6)`.
  std::string (*name)(const SolverState& state);

  /// Adds solutions by add_candidate(). Sets found.unconstrained.complete to false if solutions may
  /// be missing, and branches_complete to false if a whole branch may be missing. With
  /// request.quick, for one solution, the nearest to the seed suffices.
  void (*solve)(SolverState& state, const Request& request, StageResult& found);

  /// Whether the numerical stage is faster for one solution: the family then runs only if that
  /// stage finds none.
  bool slower_than_search = false;
};

/// Whether the task has all rows and the arm has this number of coordinates, each of one revolute
/// joint.
bool has_revolute_joints(const SolverState& state, int count);

/// Planar arms of one to three joints: planar_solver.h.
extern const AnalyticFamily planar_family;

/// Arms and tasks that PieperSolver covers: three axes of the closed loop meet or are parallel.
extern const AnalyticFamily pieper_family;

/// Arms of seven revolute joints that have a closed form when one is locked. The family applies
/// only to all solutions and to InverseMethod::closed_form: it computes the solutions on a grid of
/// values of that joint.
extern const AnalyticFamily locked_joint_family;

/// Six revolute joints of any geometry: raghavan_roth_solver.h.
extern const AnalyticFamily raghavan_roth_family;

}  // namespace beeline::internal
