#pragma once

#include <beeline/inverse/analytic/general_candidates.h>

namespace beeline {

/// The solutions found so far, as columns.
struct GeneralSolutions {
  static constexpr int most = GeneralCandidates::most;
  int count = 0;
  double q[most][6];
  double step[most] = {};  ///< how far Newton's steps moved the candidate that led here
  /// Whether the last elimination explains all: each zero of its determinant led to a solution, the
  /// solutions from before are among these, and their number is even.
  bool explained = false;
  int explained_count = -1;  ///< how many there were when that was so last
  bool close = false;        ///< some of its zeros were so close that they might be one, or more
  bool complete = false;     ///< explained by one elimination with nothing close, or by two
};

/// Adds what one elimination finds. `goal`: of the last frame; `loop`: G.
void add_solutions(const SixLinks& six, const GeneralElimination& elimination, const Motion& goal,
                   const Motion& loop, GeneralSolutions& solutions);

/// Which solution it is, to 1e-6 rad in each angle, whole turns aside; -1 if none.
int place_of(const double* q, const GeneralSolutions& solutions);

}  // namespace beeline
