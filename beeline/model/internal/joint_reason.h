#pragma once

#include <utility>
#include <vector>

#include <beeline/model/joint.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// Adds the joint to a reason: its name, and the unit of its values.
inline Reason& set_joint(const Joint& joint, Reason& reason) {
  return reason.set(ReasonField::joint, joint.name).set(ReasonField::unit, unit(joint));
}

/// A reason about a joint.
inline Reason joint_reason(ReasonCode code, const Joint& joint) {
  Reason reason{code};
  set_joint(joint, reason);
  return reason;
}

/// Returns the first of the limit_violations() of a computed configuration as a reason of another
/// code, without the guess that the value was given in degrees.
inline Reason computed_violation(const std::vector<Reason>& violations, ReasonCode code) {
  Reason reason = violations.front();
  reason.code = code;
  std::erase_if(reason.fields,
                [](const auto& field) { return field.first == ReasonField::in_degrees; });
  return reason;
}

}  // namespace beeline::internal
