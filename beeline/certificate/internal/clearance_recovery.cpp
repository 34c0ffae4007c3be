#include <algorithm>
#include <limits>

#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/certificate/internal/closest_approach.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

constexpr std::size_t least_parts = 64;  // of the recovery
constexpr double margin_of_end = 0.1;    // of the resolution, at which a pair is clear for sure

/// Adds a part of the motion to the proof of the whole. Returns whether the proof ends there: at a
/// collision, or at the second part that is not decided, because the first may touch a collision.
bool ends_with(const ClearanceProof& part, ClearanceProof& whole) {
  const bool was_clear = whole.status == ClearanceStatus::clear;
  const std::size_t parts = whole.parts + part.parts;
  if (part.status == ClearanceStatus::collides ||
      (was_clear && part.status != ClearanceStatus::clear)) {
    whole = part;
  }
  whole.parts = parts;
  return part.status != ClearanceStatus::clear &&
         !(was_clear && part.status == ClearanceStatus::not_decided);
}

/// The proof of a motion whose start is not proved to keep the clearance.
class RecoveryProof {
 public:
  RecoveryProof(const CollisionModel& model, const MotionTubes& tubes,
                const ClearanceOptions& options, BudgetMeter& budget)
      : model_(model),
        tubes_(tubes),
        options_(options),
        budget_(budget),
        at_point_(model.bodies(), tubes.values(tubes.all()), 0) {
    proof_.status = ClearanceStatus::clear;  // until a part is found that is not
  }

  ClearanceProof run() {
    find_start();
    if (kept_.empty() || !may_recover_clearance(recovery_.depth, options_.recover_clearance)) {
      ClearanceProof proof = prove_throughout(model_, tubes_, options_, budget_);
      if (!kept_.empty() && !proof) proof.recovery = recovery_;
      return proof;
    }
    const bool leads_out = find_end();
    if (budget_.complete() && prove_beginning() && budget_.complete()) {
      leads_out ? prove_remainder() : refuse_end();
    } else if (!budget_.complete() && proof_.status != ClearanceStatus::collides) {
      proof_.status = status_of<ClearanceStatus>(budget_.ending());
    }
    proof_.recovery = recovery_;
    return std::move(proof_);
  }

 private:
  const Trajectory& motion() const { return tubes_.trajectory(); }

  /// Finds the pairs that are not proved to keep their clearance at the first sample.
  void find_start() {
    const Configuration& start = motion().positions.front();
    ClearanceSearch search(model_.bodies(), tubes_, options_, budget_);
    for (const OpenPair& pair : search.open_at(start)) {
      kept_.push_back({pair, -std::numeric_limits<double>::infinity()});
    }
    std::sort(kept_.begin(), kept_.end(), [](const ReleasedPair& a, const ReleasedPair& b) {
      return TubeProof::comes_before(a.pair, b.pair);
    });
    recovery_.pairs = kept_.size();
    recovery_.sample = motion().size() - 1;
    recovery_.time = motion().times.back();
    recovery_.depth = -std::numeric_limits<double>::infinity();
    for (const BodyDistance& pair : distances_at(start)) {
      const double depth = pair.clearance - pair.lower;
      if (depth <= recovery_.depth) continue;
      recovery_.names = pair.names;
      recovery_.depth = depth;
      recovery_.distance = pair.lower;
    }
  }

  /// Sets the end of the recovery: the first sample at which all its pairs are clear, for sure if
  /// there is one. Returns false if there is none.
  bool find_end() {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t first = none, sure = none;
    for (std::size_t k = 1; k < motion().size() && sure == none; ++k) {
      if (budget_.ended(static_cast<std::int64_t>(kept_.size()))) break;
      double least = std::numeric_limits<double>::infinity();
      for (const BodyDistance& pair : distances_at(motion().positions[k])) {
        least = std::min(least, pair.lower / pair.clearance - 1);
      }
      if (least >= 0 && first == none) first = k;
      if (least >= margin_of_end * options_.resolution) sure = k;
    }
    const std::size_t end = std::min(sure, motion().size() - 1);
    recovery_.sample = sure == none && first != none ? first : end;
    recovery_.time = motion().times[recovery_.sample];
    return first != none;
  }

  std::vector<BodyDistance> distances_at(const Configuration& q) {
    const Configuration none = Configuration::Zero(q.size());
    at_point_.place({q, none, none});
    std::vector<BodyDistance> distances;
    for (const ReleasedPair& kept : kept_) distances.push_back(at_point_.distance(kept.pair));
    return distances;
  }

  /// Proves the motion up to the end of the recovery, part by part in the order of time. Returns
  /// whether it is proved.
  bool prove_beginning() {
    int halvings = 0;
    while ((recovery_.sample << halvings) < least_parts) ++halvings;
    for (std::size_t k = 0; k < recovery_.sample; ++k) {
      const ClearanceSearch::Part interval{.coefficients = tubes_.coefficients(k),
                                           .second_half = {},
                                           .from = motion().times[k],
                                           .to = motion().times[k + 1],
                                           .rounding = tubes_.rounding(k)};
      if (!prove_halves(interval, halvings)) break;
    }
    return proof_.status == ClearanceStatus::clear;
  }

  bool prove_halves(const ClearanceSearch::Part& part, int halvings) {
    if (halvings == 0 || !part.is_divisible()) return prove_part(part);
    ClearanceSearch::Part first = part, second = part;
    first.to = second.from = part.middle();
    add_halving_rounding(part.coefficients, first.rounding);
    second.rounding = first.rounding;
    halve(part.coefficients, first.coefficients, second.coefficients);
    return prove_halves(first, halvings - 1) && prove_halves(second, halvings - 1);
  }

  bool prove_part(const ClearanceSearch::Part& part) {
    if (budget_.ended(static_cast<std::int64_t>(kept_.size()))) return false;
    const std::vector<BodyDistance> distances = distances_at(part.coefficients.row(0));
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const double reached = std::min(distances[i].lower, distances[i].clearance);
      kept_[i].distance = std::max(kept_[i].distance, reached - recovery_slack);
    }
    ClearanceSearch search(model_.bodies(), tubes_, options_, budget_);
    return !ends_with(search.release(kept_).run(part), proof_);
  }

  /// Proves that all pairs keep their clearance after the recovery.
  void prove_remainder() {
    const Trajectory rest = samples_between(motion(), recovery_.sample, motion().size() - 1);
    const Trajectory adapted = adapted_motion(model_, rest);
    const MotionTubes tubes(adapted.size() > 0 ? adapted : rest);
    const ClearanceProof found = prove_throughout(model_, tubes, options_, budget_);
    const std::size_t parts = proof_.parts + found.parts;
    proof_ = found;
    proof_.parts = parts;
  }

  /// Refuses a motion at whose end a pair is still closer than its clearance.
  void refuse_end() {
    const std::vector<BodyDistance> distances = distances_at(motion().positions.back());
    const auto deepest = std::min_element(distances.begin(), distances.end(),
                                          [](const BodyDistance& a, const BodyDistance& b) {
                                            return a.lower - a.clearance < b.lower - b.clearance;
                                          });
    const bool collides = deepest->upper < deepest->clearance;
    proof_.status = collides ? ClearanceStatus::collides : ClearanceStatus::not_decided;
    proof_.pair = *deepest;
    proof_.time = proof_.begin = proof_.end = motion().times.back();
  }

  const CollisionModel& model_;
  const MotionTubes& tubes_;
  const ClearanceOptions& options_;
  BudgetMeter& budget_;
  TubeProof at_point_;
  std::vector<ReleasedPair> kept_;  ///< the pairs of the recovery, with what they must keep
  ClearanceRecovery recovery_;
  ClearanceProof proof_;
};

}  // namespace

void check_recover_clearance(double depth) {
  if (depth >= 0 && depth <= max_recover_clearance) return;
  throw Error("", "recover_clearance",
              " must be from 0 to " + number(max_recover_clearance) + " m, not " + number(depth));
}

ClearanceProof prove_throughout(const CollisionModel& model, const MotionTubes& tubes,
                                const ClearanceOptions& options, BudgetMeter& budget) {
  ClearanceProof proof = ClearanceSearch(model.bodies(), tubes, options, budget).run();
  if (options.closest && proof) find_closest_approach(model, tubes, options, budget, proof);
  return proof;
}

ClearanceProof prove_with_recovery(const CollisionModel& model, const MotionTubes& tubes,
                                   const ClearanceOptions& options, BudgetMeter& budget) {
  return RecoveryProof(model, tubes, options, budget).run();
}

}  // namespace beeline::internal
