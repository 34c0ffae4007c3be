#pragma once

#include <beeline/inverse/analytic/six_loop.h>

namespace beeline {

/// What is asked of a loop, with all six coordinates in the arm's order.
struct SixQuestion {
  double world_T_tool[12];  ///< the goal, three rows of four
  double seed[6];           ///< turns are counted from here; taken where a value is free
  double lower[6], upper[6];
  bool wraps[6];  ///< whether whole turns may be added
  double closed;  ///< a loop whose residual is larger needs mending
};

/// Up to eight branches, one in each lane: the signs of three square roots.
struct SixBranches {
  double q[6][8];          ///< by coordinate and lane: the turn nearest to the seed, within limits
                           ///< where there is one
  double residual[8];      ///< metres and radians added up: how far the loop is from closed, where
                           ///< there is no solution that of what comes near one
  double excess[8];        ///< by how much limits are exceeded, summed
  double distance[8];      ///< from the seed, squared
  unsigned found = 0;      ///< lanes whose equations have a solution, up to rounding
  unsigned within = 0;     ///< those of them within limits
  unsigned continuum = 0;  ///< those that stand for infinitely many
  unsigned weak = 0;       ///< lanes not found whose angles were read from something tiny
  unsigned twin = 0;  ///< those so near to the edge of reach that two lanes may be one solution
};

/// Eight branches in one pass. Nothing is polished: see ClosedForm.
void six_branches(const SixLoop& loop, const SixQuestion& question, SixBranches& branches);

}  // namespace beeline
