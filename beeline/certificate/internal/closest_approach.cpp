#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/certificate/internal/closest_approach.h>
#include <beeline/collision/internal/nearest_pair.h>

namespace beeline::internal {
namespace {

/// The distance of a pair beyond its clearance, m.
double excess(const BodyDistance& pair) { return pair.upper - pair.clearance; }

/// Sets the pair and the time of the proof to the closest ones of some times of the motion. Returns
/// false if the budget ends this.
bool sample_distances(const CollisionModel& model, const MotionTubes& tubes, BudgetMeter& budget,
                      ClearanceProof& proof) {
  constexpr std::size_t most = 200;
  const Trajectory& motion = tubes.trajectory();
  const ApartPairs apart = apart_pairs_of(model, tubes);
  const double begin = motion.times.front(), end = motion.times.back();
  for (std::size_t i = 0; i <= most; ++i) {
    if (budget.ended()) return false;
    const double time =
        i == most ? end
                  : begin + (end - begin) * static_cast<double>(i) / static_cast<double>(most);
    BodyDistance pair = nearest_pair(model, sample(motion, time).position, apart);
    if (i > 0 && excess(pair) >= excess(proof.pair)) continue;
    proof.pair = std::move(pair);
    proof.time = time;
  }
  return true;
}

}  // namespace

void find_closest_approach(const CollisionModel& model, const MotionTubes& tubes,
                           const ClearanceOptions& options, BudgetMeter& budget,
                           ClearanceProof& proof) {
  if (counted_pairs(model, tubes) == 0) return;
  if (!sample_distances(model, tubes, budget, proof)) return;
  double proved = 0, step = 0.01;
  constexpr int most_attempts = 20;
  for (int i = 0; i < most_attempts; ++i) {
    const double found = excess(proof.pair);
    if (!(found - proved > 0.02 * proof.pair.upper)) return;
    const double raised =
        std::max(proved, found - step * std::max(proof.pair.upper, found - proved));
    const ClearanceProof attempt =
        ClearanceSearch(model.bodies(), tubes, options, budget, raised).run();
    if (!budget.complete()) return;
    if (attempt.status == ClearanceStatus::clear) {
      proved = raised;
      proof.least_distance = std::max(proof.least_distance, attempt.least_distance);
    } else if (attempt.status == ClearanceStatus::collides && excess(attempt.pair) < found) {
      proof.pair = attempt.pair;
      proof.time = attempt.time;
      step = std::min(0.5, 1.5 * step);
    } else {
      step = std::min(0.5, 2 * step);
    }
    proof.parts += attempt.parts;
  }
}

}  // namespace beeline::internal
