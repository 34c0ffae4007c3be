#pragma once

#include <beeline/inverse/analytic/general_newton.h>

namespace beeline {

/// Configurations near which solutions are, and may be.
struct GeneralCandidates {
  static constexpr int most = 32 + 32 + 8;  ///< the last are room for whole registers
  int count = 0;
  /// How many zeros the determinant has on the circle, those counted that it nearly has. There are
  /// more candidates where two zeros may be one.
  int expected = 0;
  alignas(64) double q[6][most];  ///< joint by joint; joint `last` is left open
  /// The determinant's error against its largest value, as its Fourier coefficients tell that
  /// should be zero.
  double noise = 0;
  /// More than that, and the determinant is no polynomial of that degree.
  static constexpr double loudest = 1e-7;
};

void general_candidates(const GeneralElimination& elimination, const Motion& goal,
                        GeneralCandidates& candidates);

}  // namespace beeline
