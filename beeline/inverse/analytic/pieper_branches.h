#pragma once

#include <beeline/inverse/analytic/pieper_loop.h>

namespace beeline::internal {

/// A goal for a loop. Arrays are indexed by the arm's coordinates.
struct PieperRequest {
  double world_T_tool[12];  ///< the goal, three rows of four
  double seed[6];           ///< reference of the branches' distances; free joints take its values
  double weight[6] = {1, 1, 1, 1, 1, 1};  ///< weights of the joints in `distance`
  double lower[6], upper[6];
  bool wraps[6];        ///< whether multiples of 2 pi may be added
  double max_residual;  ///< branches with a larger residual need numerical refinement
};

/// Up to eight solution branches, one in each lane: the combinations of the signs of three square
/// roots. Masks have one bit per lane.
struct PieperBranches {
  double q[6][8];  ///< coordinates by coordinate and lane: the representative modulo 2 pi nearest
                   ///< to the seed, within limits if there is one
  double residual[8];      ///< error of the loop-closure equation, metres plus radians; in a lane
                           ///< without a solution, the error of the nearest real part
  double excess[8];        ///< sum of the limit violations
  double distance[8];      ///< squared distance from the seed, weighted
  unsigned found = 0;      ///< mask of the lanes with a solution, to rounding
  unsigned within = 0;     ///< mask of the lanes with a solution within limits
  unsigned continuum = 0;  ///< mask of the lanes that represent a continuum of solutions
  /// Masks of the lanes in which joint d, e, f or a is free and has the seed's value.
  unsigned free[4] = {};
  /// Mask of the lanes that may lack a solution because joint e or a displacement is badly
  /// determined, or not at all.
  unsigned weak = 0;
  /// Mask of the lanes so close to the workspace boundary that two may be one solution.
  unsigned twin = 0;
};

/// Computes all branches of one goal in one pass of SIMD arithmetic. Nothing is refined.
void pieper_branches(const PieperLoop& loop, const PieperRequest& request,
                     PieperBranches& branches);

}  // namespace beeline::internal
