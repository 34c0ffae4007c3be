#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/general_solutions.h>
#include <beeline/pose/angle.h>

namespace beeline {

int place_of(const double* q, const GeneralSolutions& solutions) {
  constexpr double same = 1e-6, turn = 6.283185307179586477;
  for (int place = 0; place < solutions.count; ++place) {
    bool equal = true;
    for (int i = 0; i < 6 && equal; ++i) {
      const double difference = std::abs(q[i] - solutions.q[place][i]);
      equal = difference < same || std::abs(difference - turn) < same;
    }
    if (equal) return place;
  }
  return -1;
}

void add_solutions(const SixLinks& six, const GeneralElimination& elimination, const Motion& goal,
                   const Motion& loop, GeneralSolutions& solutions) {
  GeneralCandidates candidates;
  general_candidates(elimination, loop, candidates);
  GeneralSolutions met;  // in this elimination, whether or not they are known from another
  for (int begin = 0; begin < candidates.count; begin += 8) {
    EightConfigurations eight;
    for (int i = 0; i < 6; ++i) {
      for (int lane = 0; lane < 8; ++lane) eight.q[i][lane] = candidates.q[i][begin + lane];
    }
    const unsigned arrived = newton(six, goal, elimination.last, 1e-13, eight);
    for (int lane = 0; lane < std::min(8, candidates.count - begin); ++lane) {
      if ((arrived >> lane & 1) == 0) continue;
      double q[6], step = 0;
      for (int i = 0; i < 6; ++i) {
        q[i] = wrap_angle(eight.q[i][lane]);
        if (i == elimination.last) continue;
        const double moved = eight.q[i][lane] - candidates.q[i][begin + lane];
        step = std::max(step, std::abs(wrap_angle(moved)));
      }
      if (place_of(q, met) < 0) std::copy(q, q + 6, met.q[met.count++]);
      const int place = place_of(q, solutions);
      if (place >= 0) {
        solutions.step[place] = std::min(step, solutions.step[place]);
      } else if (solutions.count < GeneralSolutions::most) {
        solutions.step[solutions.count] = step;
        std::copy(q, q + 6, solutions.q[solutions.count++]);
      }
    }
  }
  solutions.close = candidates.count > candidates.expected;
  solutions.explained = candidates.noise < GeneralCandidates::loudest &&
                        met.count == candidates.expected && solutions.count == met.count &&
                        solutions.count % 2 == 0;
  if (!solutions.explained) return;
  const bool clear = !elimination.twofold && !solutions.close;
  solutions.complete = clear || solutions.explained_count == met.count;
  solutions.explained_count = met.count;
}

}  // namespace beeline
