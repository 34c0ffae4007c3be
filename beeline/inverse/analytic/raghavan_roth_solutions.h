#pragma once

#include <optional>

#include <beeline/inverse/analytic/raghavan_roth_candidates.h>

namespace beeline::internal {

/// Longest distance from a candidate to its solution, rad. A longer one comes from a zero that
/// rounding has moved far. Near such a zero there are others, which may have become complex.
inline constexpr double max_correction = 3e-3;

/// Error of a candidate that is clearly not within max_correction of a solution, units and radians:
/// five joints turn the tool by less than 5 max_correction, the choice of joint `last` adds as much
/// to that, and no point of the arm is farther than one unit from an axis.
inline constexpr double clear_error = 10 * max_correction;

/// The solutions of one goal found so far, and the evidence that there are no others.
struct RaghavanRothSolutions {
  static constexpr int max_count = EliminationCandidates::max_count;
  int count = 0;
  double q[max_count][6];
  /// Distance by which Newton's method moved the candidate, rad.
  double correction[max_count] = {};
  /// Number of solutions with a positive determinant of the Jacobian, minus the number of the
  /// others. Of all solutions it is zero, as out of reach: solutions appear and vanish in pairs of
  /// both signs.
  int balance = 0;
  /// Whether the last elimination is consistent: each zero of its determinant led to a solution,
  /// these are all solutions found so far, and their balance is zero.
  bool consistent = false;
  /// Number of solutions of the last elimination that found all of them within max_correction of
  /// its zeros, and was consistent or had clearly no solution at each of its other zeros.
  int confirmed_count = 0;
  int confirmations = 0;      ///< by eliminations with this number; consistent ones count twice
  bool double_zeros = false;  ///< whether the last elimination had zeros that may be double
  /// Whether one elimination without double zeros is consistent, or two agree, or four of others.
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
