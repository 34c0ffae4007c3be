#include <beeline/collision/internal/pair_reason.h>

namespace beeline::internal {
namespace {

/// The reason with the fields that each reason of a pair has.
Reason reason_of(ReasonCode code, const BodyDistance& pair) {
  Reason reason{code,
                {{ReasonField::body, pair.names[0]},
                 {ReasonField::other_body, pair.names[1]},
                 {ReasonField::clearance, pair.clearance},
                 {ReasonField::position, Vector3((pair.on_first + pair.on_second) / 2)}}};
  if (pair.point) reason.set(ReasonField::point, *pair.point);
  return reason;
}

}  // namespace

Reason too_close_reason(const BodyDistance& pair) {
  if (pair.lower > 0) {
    Reason reason = reason_of(ReasonCode::bodies_too_close, pair);
    return reason.set(ReasonField::distance, pair.upper);
  }
  Reason reason = reason_of(ReasonCode::bodies_collide, pair);
  // The translation of the first body is away from the second.
  return reason.set(ReasonField::depth, -pair.lower)
      .set(ReasonField::normal, Vector3(-pair.normal));
}

Reason not_decided_reason(const BodyDistance& pair) {
  Reason reason = reason_of(ReasonCode::clearance_not_decided, pair);
  return reason.set(ReasonField::distance, pair.upper);
}

}  // namespace beeline::internal
