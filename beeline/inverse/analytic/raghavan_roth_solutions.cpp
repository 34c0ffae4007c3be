#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/raghavan_roth_newton.h>
#include <beeline/inverse/analytic/raghavan_roth_solutions.h>
#include <beeline/math/revolution.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

// Jacobian's determinant, relative to its mean. With a smaller one, another solution may be within
// about 1e-3 rad, and rounding may hide one of the two. Few random poses have a smaller one.
constexpr double regular_determinant = 1e-3;

/// Adds q unless it is known; a known solution keeps the smaller correction.
void add_solution(const double* q, double correction, double determinant,
                  RaghavanRothSolutions& solutions) {
  if (const auto known = find_solution(q, solutions)) {
    solutions.correction[*known] = std::min(correction, solutions.correction[*known]);
  } else if (solutions.count < RaghavanRothSolutions::max_count) {
    solutions.correction[solutions.count] = correction;
    std::copy(q, q + 6, solutions.q[solutions.count++]);
    solutions.balance += determinant > 0 ? 1 : -1;
  }
}

/// Draws the conclusions of an elimination that has found these solutions. `decided`: whether each
/// of its zeros led to a regular solution or clearly to none.
void conclude(const Elimination& elimination, const EliminationCandidates& candidates,
              const RaghavanRothSolutions& found, bool decided, RaghavanRothSolutions& solutions) {
  solutions.double_zeros = candidates.count > candidates.expected;
  const bool agrees = candidates.noise < EliminationCandidates::max_noise &&
                      solutions.count == found.count && found.balance == 0;
  solutions.consistent = agrees && found.count == candidates.expected;
  const bool accurate = std::all_of(found.correction, found.correction + found.count,
                                    [](double correction) { return correction < max_correction; });
  if (!agrees || !accurate || !(solutions.consistent || decided)) return;
  const bool simple = solutions.consistent && !elimination.double_zeros && !solutions.double_zeros;
  // At singular poses, as with joints at multiples of 45 degrees, two or three eliminations that
  // are not consistent may agree on solutions that are not all.
  constexpr int of_consistent = 2, enough = 4;
  if (solutions.confirmed_count != found.count) {
    solutions.confirmed_count = found.count;
    solutions.confirmations = 0;
  }
  solutions.confirmations += solutions.consistent ? of_consistent : 1;
  solutions.complete = simple || solutions.confirmations >= enough;
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
  EliminationCandidates candidates;
  elimination_candidates(elimination, closure, candidates);
  RaghavanRothSolutions found;  // of this elimination, also if another found them before
  // Whether each candidate is a regular solution or clearly none. More zeros than a determinant has
  // come from its rounding.
  bool decided = candidates.expected <= 2 * elimination.degree;
  for (int begin = 0; begin < candidates.count; begin += 8) {
    EightConfigurations eight;
    for (int i = 0; i < 6; ++i) {
      for (int lane = 0; lane < 8; ++lane) eight.q[i][lane] = candidates.q[i][begin + lane];
    }
    const unsigned converged = newton(links, goal, elimination.last, tolerance, eight);
    for (int lane = 0; lane < std::min(8, candidates.count - begin); ++lane) {
      const bool none = candidates.uncertain[begin + lane] || eight.error[lane] > clear_error;
      if ((converged >> lane & 1) == 0) {
        decided &= none;
        continue;
      }
      double q[6], correction = 0;
      for (int i = 0; i < 6; ++i) {
        q[i] = wrap_angle(eight.q[i][lane]);
        if (i == elimination.last) continue;
        const double change = eight.q[i][lane] - candidates.q[i][begin + lane];
        correction = std::max(correction, std::abs(wrap_angle(change)));
      }
      const double determinant = eight.determinant[lane];
      decided &= none || correction < max_correction;
      decided &= std::abs(determinant) > regular_determinant * links.determinant_scale;
      add_solution(q, correction, determinant, found);
      add_solution(q, correction, determinant, solutions);
    }
  }
  conclude(elimination, candidates, found, decided, solutions);
}

}  // namespace beeline::internal
