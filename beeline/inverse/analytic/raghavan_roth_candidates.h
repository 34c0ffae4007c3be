#pragma once

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>
#include <beeline/inverse/analytic/rigid_motion.h>

namespace beeline::internal {

/// Configurations at the zeros of an elimination's determinant. One is near every solution, and
/// others are not solutions.
struct EliminationCandidates {
  static constexpr int max_count = 32 + 32 + 8;  ///< simple zeros, double zeros, padding
  int count = 0;
  /// The number of zeros of the determinant, including those that are complex within its error.
  /// There are more candidates than zeros if some may be double.
  int expected = 0;
  alignas(64) double q[6][max_count];  ///< by joint; joint `last` is zero
  bool uncertain[max_count] = {};      ///< at a zero that has candidates of a double zero too
  /// The error of the determinant relative to its largest Fourier coefficient, measured by the
  /// coefficients beyond its degree.
  double noise = 0;
  /// With a larger error the determinant is not a polynomial of that degree. The bound is far above
  /// rounding and far below significant coefficients.
  static constexpr double max_noise = 1e-7;
};

/// `goal` is G of the elimination, lengths in units.
void elimination_candidates(const Elimination& elimination, const RigidMotion& goal,
                            EliminationCandidates& candidates);

}  // namespace beeline::internal
