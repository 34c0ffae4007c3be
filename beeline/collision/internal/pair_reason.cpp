#include <beeline/collision/internal/pair_reason.h>

namespace beeline::internal {
namespace {

/// Adds the joint beside the chain that carries one of the bodies.
void add_held_joint(Reason& reason, const BodyDistance& pair, std::span<const LinkShapes> links) {
  for (const std::string& body : pair.names) {
    for (const LinkShapes& link : links) {
      if (link.name != body || link.held.empty()) continue;
      const auto& [joint, value] = *link.held.begin();
      reason.set(ReasonField::held_body, body)
          .set(ReasonField::held_joint, joint)
          .set(ReasonField::held_value, value);
      return;
    }
  }
}

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

Reason too_close_reason(const BodyDistance& pair, std::span<const LinkShapes> links) {
  if (pair.lower > 0) {
    Reason reason = reason_of(ReasonCode::bodies_too_close, pair);
    add_held_joint(reason, pair, links);
    return reason.set(ReasonField::distance, pair.upper);
  }
  Reason reason = reason_of(ReasonCode::bodies_collide, pair);
  add_held_joint(reason, pair, links);
  // The translation of the first body is away from the second.
  return reason.set(ReasonField::depth, -pair.lower)
      .set(ReasonField::normal, Vector3(-pair.normal));
}

Reason not_decided_reason(const BodyDistance& pair) {
  Reason reason = reason_of(ReasonCode::clearance_not_decided, pair);
  return reason.set(ReasonField::distance, pair.upper);
}

}  // namespace beeline::internal
