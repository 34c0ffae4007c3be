#include <algorithm>
#include <cmath>
#include <ostream>

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/certificate/internal/clearance_search.h>
#include <beeline/collision/internal/pair_reason.h>
#include <beeline/internal/enum_names.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<ClearanceStatus> status_names("clearance status");

void check_options(const ClearanceOptions& options) {
  if (!(options.resolution >= 1e-6 && options.resolution <= 1)) {
    throw Error("", "resolution",
                " of " + number(options.resolution) + "; it must be from 1e-6 to 1");
  }
  internal::check_recover_clearance(options.recover_clearance);
}

Reason reason_of(const ClearanceProof& proof, Ending ending, std::span<const LinkShapes> links) {
  if (proof.status == ClearanceStatus::clear) return {};
  if (proof.status > ClearanceStatus::not_decided) {
    return internal::ended_reason(ReasonCode::ended_before_check, ending);
  }
  const bool undecided = proof.status == ClearanceStatus::not_decided;
  Reason reason = undecided ? internal::not_decided_reason(proof.pair)
                            : internal::too_close_reason(proof.pair, links);
  reason.set(ReasonField::time, proof.time);
  if (undecided) reason.set(ReasonField::begin, proof.begin).set(ReasonField::end, proof.end);
  return reason;
}

}  // namespace

std::string name(ClearanceStatus status) { return status_names.of(status); }

std::ostream& operator<<(std::ostream& out, ClearanceStatus status) { return out << name(status); }

std::ostream& operator<<(std::ostream& out, const ClearanceProof& proof) {
  out << name(proof.status);
  if (!proof) return out << ": " << proof.reason;
  if (std::isinf(proof.least_distance)) return out << ", but no pair of bodies counts";
  if (proof.pairs == 0) return out << ", no pair meets within the position limits";
  out << (proof.pairs == 1 ? ", the pair that counts keeps at least "
                           : ", each of the " + std::to_string(proof.pairs) +
                                 " pairs that count keeps at least ")
      << number(rounded_down(proof.least_distance, 6)) << " m";
  if (proof.recovery) out << " from " << number(proof.recovery->time) << " s on";
  if (proof.pair.names[0].empty()) return out;
  return out << "; nearest " << names_text(proof.pair) << " at " << number(proof.time) << " s";
}

ClearanceProof prove_clearance(const CollisionModel& model, const Trajectory& trajectory,
                               const ClearanceOptions& options) {
  check_options(options);
  const Trajectory adapted = internal::adapted_motion(model, trajectory);
  internal::BudgetMeter budget(options.budget);
  const internal::MotionTubes tubes(adapted.size() > 0 ? adapted : trajectory);
  ClearanceProof proof = options.recover_clearance > 0
                             ? internal::prove_with_recovery(model, tubes, options, budget)
                             : internal::prove_throughout(model, tubes, options, budget);
  if (!proof) proof.least_distance = ClearanceProof().least_distance;
  // A trajectory of one sample is proved as a rest.
  for (double* time : {&proof.time, &proof.begin, &proof.end}) {
    *time = std::min(*time, trajectory.times.back());
  }
  proof.pairs = internal::counted_pairs(model, tubes);
  proof.reason = reason_of(proof, budget.ending(), model.links());
  return proof;
}

}  // namespace beeline
