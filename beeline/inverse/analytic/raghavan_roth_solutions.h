#pragma once

#include <optional>

#include <beeline/inverse/analytic/raghavan_roth_candidates.h>

namespace beeline::internal {

/// The solutions of one goal found so far, and the evidence that there are no others.
struct RaghavanRothSolutions {
  static constexpr int max_count = EliminationCandidates::max_count;
  int count = 0;
  double q[max_count][6];
  /// Distance by which Newton's method moved the candidate, rad.
  double correction[max_count] = {};
  /// Whether the last elimination is consistent: each zero of its determinant led to a solution,
  /// these are all solutions found so far, and their number is even.
  bool consistent = false;
  /// Number of solutions when an accurate elimination was last consistent.
  std::optional<int> consistent_count;
  bool double_zeros = false;  ///< whether the last elimination had zeros that may be double
  /// Whether one elimination without double zeros is consistent, or two agree.
  bool complete = false;
};

/// Adds the solutions of one elimination. `goal` is the pose of the last frame, `closure` is G of
/// the elimination; lengths in units.
void add_solutions(const RevoluteLinks& links, const Elimination& elimination,
                   const RigidMotion& goal, const RigidMotion& closure,
                   RaghavanRothSolutions& solutions);

/// Returns the index of a solution equal to q, to 1e-6 rad in each angle and modulo 2 pi.
std::optional<int> find_solution(const double* q, const RaghavanRothSolutions& solutions);

}  // namespace beeline::internal
