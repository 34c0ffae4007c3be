#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/raghavan_roth_newton.h>
#include <beeline/inverse/analytic/raghavan_roth_solutions.h>
#include <beeline/math/revolution.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// Adds q unless it is known; a known solution keeps the smaller correction.
void add_solution(const double* q, double correction, RaghavanRothSolutions& solutions) {
  if (const auto known = find_solution(q, solutions)) {
    solutions.correction[*known] = std::min(correction, solutions.correction[*known]);
  } else if (solutions.count < RaghavanRothSolutions::max_count) {
    solutions.correction[solutions.count] = correction;
    std::copy(q, q + 6, solutions.q[solutions.count++]);
  }
}

}  // namespace

std::optional<int> find_solution(const double* q, const RaghavanRothSolutions& solutions) {
  constexpr double same = 1e-6;
  for (int index = 0; index < solutions.count; ++index) {
    bool equal = true;
    for (int i = 0; i < 6 && equal; ++i) {
      const double difference = std::abs(q[i] - solutions.q[index][i]);
      equal = difference < same || std::abs(difference - revolution) < same;
    }
    if (equal) return index;
  }
  return std::nullopt;
}

void add_solutions(const RevoluteLinks& links, const Elimination& elimination,
                   const RigidMotion& goal, const RigidMotion& closure,
                   RaghavanRothSolutions& solutions) {
  constexpr double tolerance = 1e-13;  // units and radians: Newton's method ends at rounding
  // Radians. A longer correction comes from a zero that rounding has moved far. Near such a zero
  // there are others, which may have become complex.
  constexpr double max_correction = 3e-3;
  EliminationCandidates candidates;
  elimination_candidates(elimination, closure, candidates);
  RaghavanRothSolutions
      found;  // solutions of this elimination, also if another elimination found them before
  for (int begin = 0; begin < candidates.count; begin += 8) {
    EightConfigurations eight;
    for (int i = 0; i < 6; ++i) {
      for (int lane = 0; lane < 8; ++lane) eight.q[i][lane] = candidates.q[i][begin + lane];
    }
    const unsigned converged = newton(links, goal, elimination.last, tolerance, eight);
    for (int lane = 0; lane < std::min(8, candidates.count - begin); ++lane) {
      if ((converged >> lane & 1) == 0) continue;
      double q[6], correction = 0;
      for (int i = 0; i < 6; ++i) {
        q[i] = wrap_angle(eight.q[i][lane]);
        if (i == elimination.last) continue;
        const double change = eight.q[i][lane] - candidates.q[i][begin + lane];
        correction = std::max(correction, std::abs(wrap_angle(change)));
      }
      add_solution(q, correction, found);
      add_solution(q, correction, solutions);
    }
  }
  solutions.double_zeros = candidates.count > candidates.expected;
  solutions.consistent = candidates.noise < EliminationCandidates::max_noise &&
                         found.count == candidates.expected && solutions.count == found.count &&
                         solutions.count % 2 == 0;
  const bool accurate = std::all_of(found.correction, found.correction + found.count,
                                    [](double correction) { return correction < max_correction; });
  if (!solutions.consistent || !accurate) return;
  const bool simple = !elimination.double_zeros && !solutions.double_zeros;
  solutions.complete = simple || solutions.consistent_count == found.count;
  solutions.consistent_count = found.count;
}

}  // namespace beeline::internal
